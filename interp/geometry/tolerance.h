// Below which lengths and angles two things are one.
#pragma once

namespace ncvet {

struct Tolerance {
  static constexpr double parallel = 1e-9; ///< sine of the angle between two directions
  static constexpr double nothing = 1e-9;  ///< a length in mm, or an angle in turns
  static constexpr double roundedRadius =
      0.01; ///< mm by which half a chord may be longer than the radius: it is half a turn
  static constexpr double point =
      1e-6; ///< mm between the ends of a circle, or what a triangle spans
};

} // namespace ncvet
