// The geometry of an arc: start, end, centre, radius.
#pragma once

#include "interp/geometry/circle.h"

namespace ncvet {

/// Where an arc leads, in millimetres in its plane, diameters turned into radii. What is not known
/// is absent.
struct ArcGeometry {
  std::optional<Point> start, end;
  std::optional<Point> centreWords; ///< I J K as they are; an absent one is zero
  bool centreAbsolute =
      false; ///< they are coordinates of the centre, not its distance from the start
  std::optional<double> radius; ///< R with its sign

  /// Centre as the control reads it.
  std::optional<Point> centre() const;
};

} // namespace ncvet
