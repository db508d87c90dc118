// Circles of a plane: where lines and other circles meet them.
#pragma once

#include "interp/geometry/direction.h"

#include <optional>

namespace ncvet {

/// The point of a circle at that angle, in radians.
inline Point pointOnCircle(const Point &centre, double radius, double angle) {
  return centre + radius * unitVector(angle);
}

/// By how much the distances of two points from the centre differ: zero when a circle about it
/// leads through both.
inline double radiusDifference(const Point &centre, const Point &a, const Point &b) {
  return std::fabs(distance(a, centre) - distance(b, centre));
}

inline double circumferenceOf(double diameter) { return std::numbers::pi * diameter; }

/// How far an arc has turned, in radians from 0 to below a full turn, when it comes from one angle
/// to another.
double turnBetween(double from, double to, bool clockwise);

/// Part of a full turn that the shorter arc over a chord of that length makes.
double turnsOverChord(double chord, double radius);

/// Angle of the path from one point to another round `centre`, in full turns: above 0, at most 1.
double turnsAround(const Point &centre, const Point &from, const Point &to, bool clockwise);

/// Centre of the arc of that radius between two points: the one whose path is at most half a turn,
/// the other one for a negative radius. None when the points are further apart than a diameter.
std::optional<Point> centreByRadius(const Point &start, const Point &end, double radius,
                                    bool clockwise);

/// Centre of the arc of that opening angle (degrees, below 360) between two points.
std::optional<Point> centreByAngle(const Point &start, const Point &end, double degrees,
                                   bool clockwise);

/// Centre of the circle through three points; none when they are on a line.
std::optional<Point> centreOfThree(const Point &a, const Point &b, const Point &c);

} // namespace ncvet
