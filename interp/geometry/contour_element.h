// Straight lines and arcs of a contour in their plane, and where paths beside them meet.
#pragma once

#include "interp/geometry/circle.h"
#include "interp/geometry/line.h"
#include "interp/geometry/move.h"

#include <optional>

namespace ncvet {

/// A straight line or an arc in a plane, lengths in millimetres.
struct ContourElement {
  Vector from, to, centre;
  bool arc = false, clockwise = false;

  double radius() const { return (from - centre).norm(); }
  double length() const;
  /// Direction of travel at a point of the element.
  Vector direction(const Vector &at) const {
    if (!arc)
      return (to - from).normalized();
    const Vector turn = leftOf((at - centre).normalized());
    return clockwise ? Vector(-turn) : turn;
  }
  /// Radius of the circle at the distance `left` on the left of an arc; at most zero when there is
  /// no room for one.
  double radiusBeside(double left) const { return radius() + (clockwise ? left : -left); }
};

/// The point at the distance `left` on the left of both elements that is nearest to `corner`; none
/// when the paths beside them do not meet.
std::optional<Vector> meetingBeside(const ContourElement &a, const ContourElement &b, double left,
                                    const Vector &corner);

/// The point of the line or the full circle of an element that is nearest to `point`.
Vector footOn(const ContourElement &element, const Vector &point);

/// Millimetres along the element from one of its points to another, below zero against its
/// direction; of an arc the shorter way.
double lengthBetween(const ContourElement &element, const Vector &from, const Vector &to);

/// Places between the coordinates of moves and a plane, in which X of a lathe is a radius.
class ContourPlane {
public:
  ContourPlane(const Dialect &dialect, const std::array<Axis, 2> &axes);

  const std::array<Axis, 2> &axes() const { return axes_; }
  std::optional<Vector> point(const Place &place) const;
  /// What is known of a point.
  std::array<std::optional<double>, 2> partly(const Place &place) const;
  uint16_t bit(size_t i) const { return uint16_t(1u << unsigned(axes_[i])); }
  void set(Place &place, const Vector &point) const;
  /// The element that a cut from `from` makes; none for a move without length, or when not all is
  /// known.
  std::optional<ContourElement> element(const Place &from, const Move &move) const;
  /// An arc gets its angle anew when its ends have moved.
  void retrim(Move &move, const Place &from) const;
  /// A move like `like` along that arc.
  Move arc(const Move &like, const ContourElement &arc) const;

private:
  std::array<Axis, 2> axes_;
  std::array<double, 2> factor_{1, 1};
};

} // namespace ncvet
