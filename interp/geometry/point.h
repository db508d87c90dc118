// Points and vectors of a plane.
#pragma once

#include <Eigen/Core>

#include <cmath>

namespace ncvet {

/// A place in a plane, in millimetres.
using Point = Eigen::Vector2d;
/// What leads from one place of a plane to another.
using Vector = Eigen::Vector2d;

inline double distance(const Point &a, const Point &b) {
  const double x = b.x() - a.x(), y = b.y() - a.y();
  return std::sqrt(x * x + y * y); // no length is so great that its square is none
}

/// Turned by a quarter, counter-clockwise.
inline Vector leftOf(const Vector &v) { return {-v.y(), v.x()}; }

/// Above zero when `b` leads to the left of `a`; of unit vectors the sine of the angle between.
inline double cross(const Vector &a, const Vector &b) { return a.x() * b.y() - a.y() * b.x(); }

} // namespace ncvet
