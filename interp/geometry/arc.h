// The geometry of an arc: start, end, centre, radius.
#pragma once

#include <array>
#include <optional>

namespace ncvet {

/// Where an arc leads, in millimetres in its plane, diameters turned into radii. What is not known
/// is absent.
struct ArcGeometry {
  using Point = std::array<double, 2>;
  std::optional<Point> start, end;
  std::optional<Point> centreWords; ///< I J K as they are; an absent one is zero
  bool centreAbsolute =
      false; ///< they are coordinates of the centre, not its distance from the start
  std::optional<double> radius; ///< R with its sign

  /// Centre as the control reads it.
  std::optional<Point> centre() const;
};

/// Centre of the arc of that radius between two points: the one whose way is at most half a turn,
/// the other one for a negative radius. None when the points are further apart than a diameter.
std::optional<ArcGeometry::Point> centreByRadius(const ArcGeometry::Point &start,
                                                 const ArcGeometry::Point &end, double radius,
                                                 bool clockwise);

} // namespace ncvet
