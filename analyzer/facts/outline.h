// A closed contour of lines and arcs, and what lies outside of it.
#pragma once

#include "interp/geometry/circle.h"
#include "interp/geometry/line.h"

#include <vector>

namespace ncvet {

/// A closed contour as a polygon; arcs as many short sides.
class Outline {
public:
  void clear() { *this = Outline(); }
  void loseTrack() { drawn_.known = false; }
  void start(const Point &at) { drawn_.points.assign(1, at); }
  void line(const Point &to) { drawn_.points.push_back(to); }

  /// An arc from the last point about `centre`; none that ends where it begins is a full circle.
  void arc(const Point &centre, Point to, bool clockwise) {
    if (drawn_.points.empty())
      return loseTrack();
    const Point from = drawn_.points.back();
    const double radius = distance(centre, from);
    const double begin = angleOf(from - centre);
    double turn = angleOf(to - centre) - begin;
    if (clockwise && turn > -1e-9)
      turn -= fullTurn;
    if (!clockwise && turn < 1e-9)
      turn += fullTurn;
    constexpr double sides = 720; // of a full circle: half a micrometre off at a radius of 50 mm
    const auto steps = unsigned(std::ceil(std::fabs(turn) / fullTurn * sides));
    for (unsigned i = 1; i < steps; ++i) {
      drawn_.points.push_back(pointOnCircle(centre, radius, begin + turn * i / steps));
    }
    drawn_.points.push_back(to);
  }

  bool isClosed() const {
    return drawn_.known && drawn_.points.size() > 3 &&
           distance(drawn_.points.front(), drawn_.points.back()) < least;
  }
  bool hasStart() const { return drawn_.known && !drawn_.points.empty(); }
  const Point &first() const { return drawn_.points.front(); }

  /// Whether a point lies outside, and not on the outline.
  bool excludes(const Point &p) const {
    bool inside = false;
    for (size_t i = 0; i + 1 < drawn_.points.size(); ++i) {
      const Point &a = drawn_.points[i], &b = drawn_.points[i + 1];
      if (distanceFromSegment(a, b, p) < least)
        return false;
      if ((a[1] > p[1]) != (b[1] > p[1]) &&
          p[0] < a[0] + (b[0] - a[0]) * (p[1] - a[1]) / (b[1] - a[1]))
        inside = !inside;
    }
    return !inside;
  }

  /// Whether a point lies inside, and not on the outline.
  bool encloses(const Point &p) const {
    if (excludes(p))
      return false;
    for (size_t i = 0; i + 1 < drawn_.points.size(); ++i)
      if (distanceFromSegment(drawn_.points[i], drawn_.points[i + 1], p) < least)
        return false;
    return drawn_.points.size() > 3;
  }

  const auto &remembered() const { return drawn_; }

private:
  /// What lies nearer to the outline counts as on it, millimetres.
  static constexpr double least = 0.01;

  struct Drawn {
    std::vector<Point> points;
    bool known = true;
  };
  Drawn drawn_;
};

} // namespace ncvet
