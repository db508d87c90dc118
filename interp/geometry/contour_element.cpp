// Straight lines and arcs of a contour in their plane, and where paths beside them meet.
#include "interp/geometry/contour_element.h"

#include "interp/geometry/tolerance.h"

#include <numbers>

namespace ncvet {

namespace {

Vector nearestTo(const Vector &corner, const Vector &p, const Vector &q) {
  return (p - corner).squaredNorm() < (q - corner).squaredNorm() ? p : q;
}

std::optional<Vector> meeting(const ContourElement &line, const ContourElement &arc, double left,
                              const Vector &corner) {
  const Vector d = line.direction(line.from), p = line.from + leftOf(d) * left;
  const double r = arc.radiusBeside(left);
  const Vector foot = footOnLine(p, d, arc.centre);
  const double square = r * r - (arc.centre - foot).squaredNorm();
  if (r <= 0 || square < 0)
    return std::nullopt;
  const Vector half = d * std::sqrt(square);
  return nearestTo(corner, foot + half, foot - half);
}

} // namespace

double ContourElement::length() const {
  return arc ? turnsAround(centre, from, to, clockwise) * 2 * std::numbers::pi * radius()
             : (to - from).norm();
}

std::optional<Vector> meetingBeside(const ContourElement &a, const ContourElement &b, double left,
                                    const Vector &corner) {
  if (!a.arc && !b.arc) {
    const Vector d = a.direction(a.from), e = b.direction(b.from);
    return intersection(a.from + leftOf(d) * left, d, b.from + leftOf(e) * left, e);
  }
  if (a.arc != b.arc)
    return meeting(a.arc ? b : a, a.arc ? a : b, left, corner);
  const double r = a.radiusBeside(left), s = b.radiusBeside(left);
  const Vector between = b.centre - a.centre;
  const double distance = between.norm();
  if (r <= 0 || s <= 0 || distance < Tolerance::nothing)
    return std::nullopt;
  const double along = (r * r - s * s + distance * distance) / (2 * distance);
  const double square = r * r - along * along;
  if (square < 0)
    return std::nullopt;
  const Vector unit = between / distance, foot = a.centre + unit * along;
  const Vector half = leftOf(unit) * std::sqrt(square);
  return nearestTo(corner, foot + half, foot - half);
}

Vector footOn(const ContourElement &element, const Vector &point) {
  if (element.arc)
    return element.centre + (point - element.centre).normalized() * element.radius();
  return footOnLine(element.from, element.direction(element.from), point);
}

double lengthBetween(const ContourElement &element, const Vector &from, const Vector &to) {
  if (!element.arc)
    return (to - from).dot(element.direction(from));
  const double turns = turnsAround(element.centre, from, to, element.clockwise);
  return (turns > 0.5 ? turns - 1 : turns) * 2 * std::numbers::pi * element.radius();
}

ContourPlane::ContourPlane(const Dialect &dialect, const std::array<Axis, 2> &axes) : axes_(axes) {
  for (size_t i = 0; i < 2; ++i)
    factor_[i] = dialect.lengthsPerUnit(axes[i]);
}

std::array<std::optional<double>, 2> ContourPlane::partly(const Place &place) const {
  std::array<std::optional<double>, 2> result;
  for (size_t i = 0; i < 2; ++i)
    if (const Interval &x = place[size_t(axes_[i])]; x.isConstant())
      result[i] = x.value() / factor_[i];
  return result;
}

std::optional<Vector> ContourPlane::point(const Place &place) const {
  const auto known = partly(place);
  return known[0] && known[1] ? std::optional(Vector(*known[0], *known[1])) : std::nullopt;
}

void ContourPlane::set(Place &place, const Vector &point) const {
  for (size_t i = 0; i < 2; ++i)
    place[size_t(axes_[i])] = Interval::exactly(point(int(i)) * factor_[i]);
}

std::optional<ContourElement> ContourPlane::element(const Place &from, const Move &move) const {
  const auto begin = point(from), end = point(move.to);
  if (!begin || !end || move.machineAxes & (bit(0) | bit(1)))
    return std::nullopt;
  ContourElement element{*begin, *end, *begin, move.kind == MoveKind::Arc, move.clockwise};
  if (element.arc) {
    if (!move.centre[0].isConstant() || !move.centre[1].isConstant())
      return std::nullopt;
    element.centre = {move.centre[0].value() / factor_[0], move.centre[1].value() / factor_[1]};
  } else if ((*end - *begin).norm() < Tolerance::nothing) {
    return std::nullopt;
  }
  return element;
}

void ContourPlane::retrim(Move &move, const Place &from) const {
  if (const auto e = element(from, move); e && e->arc)
    move.turns = Interval::exactly(turnsAround(e->centre, e->from, e->to, e->clockwise));
}

Move ContourPlane::arc(const Move &like, const ContourElement &arc) const {
  Move move = like;
  move.kind = MoveKind::Arc;
  set(move.to, arc.to);
  move.plane = axes_;
  for (size_t i = 0; i < 2; ++i)
    move.centre[i] = Interval::exactly(arc.centre(int(i)) * factor_[i]);
  move.clockwise = arc.clockwise;
  move.turns = Interval::exactly(turnsAround(arc.centre, arc.from, arc.to, arc.clockwise));
  return move;
}

} // namespace ncvet
