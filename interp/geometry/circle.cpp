// Circles of a plane: where lines and other circles meet them.
#include "interp/geometry/circle.h"

#include "interp/geometry/tolerance.h"

#include <numbers>

namespace ncvet {

double turnBetween(double from, double to, bool clockwise) {
  const double turn = clockwise ? from - to : to - from;
  return turn - std::floor(turn / fullTurn) * fullTurn;
}

double turnsOverChord(double chord, double radius) {
  return std::asin(std::fmin(1, chord / (2 * radius))) / std::numbers::pi;
}

double turnsAround(const Point &centre, const Point &from, const Point &to, bool clockwise) {
  double turns = angleBetween(from - centre, to - centre) / fullTurn;
  if (clockwise)
    turns = -turns;
  if (turns < 0)
    turns += 1;
  return turns < Tolerance::nothing ? 1 : turns;
}

std::optional<Point> centreByRadius(const Point &start, const Point &end, double radius,
                                    bool clockwise) {
  const double dx = end.x() - start.x(), dy = end.y() - start.y();
  const double chord = std::hypot(dx, dy);
  if (chord < Tolerance::point)
    return std::nullopt;
  if (chord / 2 - std::fabs(radius) > Tolerance::roundedRadius)
    return std::nullopt;
  const double square = std::max(0.0, radius * radius - chord * chord / 4);
  const double side = (clockwise ? -1 : 1) * (radius < 0 ? -1 : 1) * std::sqrt(square) / chord;
  return Point(start.x() + dx / 2 - dy * side, start.y() + dy / 2 + dx * side);
}

std::optional<Point> centreByAngle(const Point &start, const Point &end, double degrees,
                                   bool clockwise) {
  const double sine = std::sin(degrees * std::numbers::pi / 360);
  const double chord = distance(start, end);
  if (degrees <= 0 || degrees >= 360 || sine <= 0)
    return std::nullopt;
  const double radius = chord / (2 * sine);
  return centreByRadius(start, end, degrees > 180 ? -radius : radius, clockwise);
}

std::optional<Point> centreOfThree(const Point &a, const Point &b, const Point &c) {
  const Vector u = b - a, v = c - a;
  const double twice = 2 * cross(u, v);
  if (std::fabs(twice) < Tolerance::point)
    return std::nullopt;
  const double b2 = u.x() * u.x() + u.y() * u.y(), c2 = v.x() * v.x() + v.y() * v.y();
  return Point(a.x() + (v.y() * b2 - u.y() * c2) / twice,
               a.y() + (u.x() * c2 - v.x() * b2) / twice);
}

} // namespace ncvet
