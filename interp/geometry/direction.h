// Angles and unit vectors of a plane. Angles count counter-clockwise from its first axis.
#pragma once

#include "interp/geometry/point.h"

#include <numbers>

namespace ncvet {

constexpr double fullTurn = 2 * std::numbers::pi;
constexpr double halfTurn = std::numbers::pi;
constexpr double quarterTurn = std::numbers::pi / 2;

constexpr double radiansOf(double degrees) { return degrees * std::numbers::pi / 180; }
constexpr double degreesOf(double radians) { return radians * 180 / std::numbers::pi; }

inline double sineOf(double degrees) { return std::sin(radiansOf(degrees)); }
inline double tangentOf(double degrees) { return std::tan(radiansOf(degrees)); }

/// The unit vector at that angle, in radians.
inline Vector unitVector(double angle) { return {std::cos(angle), std::sin(angle)}; }

/// In radians, above -pi, at most pi.
inline double angleOf(const Vector &v) { return std::atan2(v.y(), v.x()); }

/// By how much `b` is turned from `a`: radians, counter-clockwise above zero.
inline double angleBetween(const Vector &a, const Vector &b) {
  return std::atan2(cross(a, b), a.dot(b));
}

/// How far beyond a corner the paths at that distance beside its two lines meet; `turn` is the
/// angle between their directions in radians, below half a turn.
inline double reachOfCorner(double distance, double turn) { return distance * std::tan(turn / 2); }

/// What a chamfer of that width takes of each of the two lines whose directions it joins.
inline double legOfChamfer(double width, const Vector &in, const Vector &out) {
  return width / std::sqrt(2 + 2 * in.dot(out));
}

/// `v` turned, by radians.
inline Vector turnedBy(const Vector &v, double angle) {
  const Vector direction = unitVector(angle);
  return {v.x() * direction.x() - v.y() * direction.y(),
          v.x() * direction.y() + v.y() * direction.x()};
}

/// `point` turned about `centre`, by radians.
inline Point turnedAbout(const Point &centre, const Point &point, double angle) {
  return centre + turnedBy(point - centre, angle);
}

} // namespace ncvet
