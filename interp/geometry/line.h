// Straight lines of a plane.
#pragma once

#include "interp/geometry/direction.h"

#include <optional>

namespace ncvet {

/// Directions are parallel when their sine is below this.
constexpr double parallelSine = 1e-6;

/// Where two lines meet, each given by a point and a direction; none when they are parallel.
std::optional<Point> intersection(const Point &p, const Vector &d, const Point &q, const Vector &e);

/// The point of a line that is nearest to `point`; `direction` has the length one.
inline Point footOnLine(const Point &on, const Vector &direction, const Point &point) {
  return on + direction * direction.dot(point - on);
}

/// Distance of `point` from the line through `on` at that angle, in radians.
inline double distanceFromLine(const Point &on, double angle, const Point &point) {
  return std::fabs((point.x() - on.x()) * std::sin(angle) - (point.y() - on.y()) * std::cos(angle));
}

/// Distance of `point` from the straight way between `a` and `b`.
double distanceFromSegment(const Point &a, const Point &b, const Point &point);

/// A place in space, in millimetres.
using SpacePoint = Eigen::Vector3d;

/// Where a point lies about the line from `a` to `b`.
struct PlaceOnLine {
  double along; ///< of its foot: 0 at `a`, 1 at `b`
  double aside; ///< mm from the line
};
PlaceOnLine placeOnLine(const SpacePoint &a, const SpacePoint &b, const SpacePoint &point);

} // namespace ncvet
