// Straight lines of a plane.
#include "interp/geometry/line.h"

#include "interp/geometry/tolerance.h"

namespace ncvet {

std::optional<Point> intersection(const Point &p, const Vector &d, const Point &q,
                                  const Vector &e) {
  const double sine = cross(d, e);
  if (std::fabs(sine) < Tolerance::parallel)
    return std::nullopt;
  return Point(p + d * (cross(q - p, e) / sine));
}

double distanceFromSegment(const Point &a, const Point &b, const Point &point) {
  const double x = b.x() - a.x(), y = b.y() - a.y();
  const double length = x * x + y * y;
  double t = length > 0 ? ((point.x() - a.x()) * x + (point.y() - a.y()) * y) / length : 0;
  t = std::fmin(1, std::fmax(0, t));
  return std::hypot(point.x() - a.x() - t * x, point.y() - a.y() - t * y);
}

PlaceOnLine placeOnLine(const SpacePoint &a, const SpacePoint &b, const SpacePoint &point) {
  const SpacePoint line = b - a;
  const double along = (point - a).dot(line) / line.squaredNorm();
  return {along, (point - a - along * line).norm()};
}

} // namespace ncvet
