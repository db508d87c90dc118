// A closed contour of lines and arcs, and what lies outside of it.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace ncvet {

/// A closed contour as a polygon; arcs as many short sides.
class Outline {
public:
  using Point = std::array<double, 2>;

  void clear() { *this = Outline(); }
  void loseTrack() { known_ = false; }
  void start(const Point &at) { points_.assign(1, at); }
  void line(const Point &to) { points_.push_back(to); }

  /// An arc from the last point about `centre`; none that ends where it begins is a full circle.
  void arc(const Point &centre, Point to, bool clockwise) {
    if (points_.empty())
      return loseTrack();
    const Point from = points_.back();
    const double radius = std::hypot(from[0] - centre[0], from[1] - centre[1]);
    const double begin = std::atan2(from[1] - centre[1], from[0] - centre[0]);
    double turn = std::atan2(to[1] - centre[1], to[0] - centre[0]) - begin;
    constexpr double full = 2 * std::numbers::pi;
    if (clockwise && turn > -1e-9)
      turn -= full;
    if (!clockwise && turn < 1e-9)
      turn += full;
    constexpr double sides = 720; // of a full circle: half a micrometre off at a radius of 50 mm
    const auto steps = unsigned(std::ceil(std::fabs(turn) / full * sides));
    for (unsigned i = 1; i < steps; ++i) {
      const double angle = begin + turn * i / steps;
      points_.push_back(
          {centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)});
    }
    points_.push_back(to);
  }

  bool isClosed() const {
    return known_ && points_.size() > 3 &&
           std::hypot(points_.back()[0] - points_.front()[0],
                      points_.back()[1] - points_.front()[1]) < least;
  }
  bool hasStart() const { return known_ && !points_.empty(); }
  const Point &first() const { return points_.front(); }

  /// Whether a point lies outside, and not on the outline.
  bool excludes(const Point &p) const {
    bool inside = false;
    for (size_t i = 0; i + 1 < points_.size(); ++i) {
      const Point &a = points_[i], &b = points_[i + 1];
      if (distance(p, a, b) < least)
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
    for (size_t i = 0; i + 1 < points_.size(); ++i)
      if (distance(p, points_[i], points_[i + 1]) < least)
        return false;
    return points_.size() > 3;
  }

  /// See `Rule::remember`.
  template <typename Memory>
  void remember(Memory &memory) const {
    memory(points_, known_);
  }

private:
  /// What lies nearer to the outline counts as on it, millimetres.
  static constexpr double least = 0.01;

  static double distance(const Point &p, const Point &a, const Point &b) {
    const double x = b[0] - a[0], y = b[1] - a[1];
    const double length = x * x + y * y;
    double t = length > 0 ? ((p[0] - a[0]) * x + (p[1] - a[1]) * y) / length : 0;
    t = std::fmin(1, std::fmax(0, t));
    return std::hypot(p[0] - a[0] - t * x, p[1] - a[1] - t * y);
  }

  std::vector<Point> points_;
  bool known_ = true;
};

} // namespace ncvet
