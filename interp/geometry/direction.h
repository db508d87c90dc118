// Angles and unit vectors of a plane. Angles count counter-clockwise from its first axis.
#pragma once

#include "interp/geometry/point.h"

#include <numbers>

namespace ncvet {

constexpr double fullTurn = 2 * std::numbers::pi;

constexpr double radiansOf(double degrees) { return degrees * std::numbers::pi / 180; }

/// The unit vector at that angle, in radians.
inline Vector unitVector(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// In radians, above -pi, at most pi.
inline double angleOf(const Vector &v) { return std::atan2(v.y(), v.x()); }

/// By how much `b` is turned from `a`: radians, counter-clockwise above zero.
inline double angleBetween(const Vector &a, const Vector &b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// `point` turned about `centre`, by radians.
inline Point turnedAbout(const Point &centre, const Point &point, double angle) {
  const double x = point.x() - centre.x(), y = point.y() - centre.y();
  return {centre.x() + x * std::cos(angle) - y * std::sin(angle),
          centre.y() + x * std::sin(angle) + y * std::cos(angle)};
}

} // namespace ncvet
