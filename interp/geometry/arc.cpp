// The geometry of an arc: start, end, centre, radius.
#include "interp/geometry/arc.h"

#include <cmath>

namespace ncvet {

namespace {
/// Ends of a circle that are closer than this (mm) are one point.
constexpr double closeBy = 1e-6;
} // namespace

std::optional<ArcGeometry::Point> ArcGeometry::centre() const {
  if (!centreWords)
    return std::nullopt;
  if (centreAbsolute)
    return centreWords;
  if (!start)
    return std::nullopt;
  return Point{(*start)[0] + (*centreWords)[0], (*start)[1] + (*centreWords)[1]};
}

std::optional<ArcGeometry::Point> centreByRadius(const ArcGeometry::Point &start,
                                                 const ArcGeometry::Point &end, double radius,
                                                 bool clockwise) {
  const double dx = end[0] - start[0], dy = end[1] - start[1];
  const double chord = std::hypot(dx, dy);
  if (chord < closeBy)
    return std::nullopt;
  double square = radius * radius - chord * chord / 4;
  if (square < 0) {
    if (square < -closeBy * std::fabs(radius) - closeBy)
      return std::nullopt;
    square = 0;
  }
  const double side = (clockwise ? -1 : 1) * (radius < 0 ? -1 : 1) * std::sqrt(square) / chord;
  return ArcGeometry::Point{start[0] + dx / 2 - dy * side, start[1] + dy / 2 + dx * side};
}

} // namespace ncvet
