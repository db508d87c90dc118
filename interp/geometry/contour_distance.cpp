// Least distances between straight lines and arcs of a plane.
#include "interp/geometry/contour_distance.h"

#include <algorithm>
#include <cmath>

namespace ncvet {

namespace {

/// Whether the ray or normal that leads to `at` meets the element between its two ends.
bool spans(const ContourElement &element, const Vector &at) {
  if (element.arc)
    return turnsAround(element.centre, element.from, at, element.clockwise) <=
           turnsAround(element.centre, element.from, element.to, element.clockwise);
  const Vector along = element.to - element.from;
  const double way = along.dot(at - element.from);
  return way >= 0 && way <= along.squaredNorm();
}

double distanceTo(const ContourElement &element, const Vector &point) {
  const double ends = std::min((point - element.from).norm(), (point - element.to).norm());
  if (element.arc && (point - element.centre).squaredNorm() == 0)
    return element.radius();
  const Vector foot = footOn(element, point);
  return spans(element, foot) ? std::min(ends, (point - foot).norm()) : ends;
}

bool crossLines(const ContourElement &a, const ContourElement &b) {
  const auto at = intersection(a.from, a.to - a.from, b.from, b.to - b.from);
  return at && spans(a, *at) && spans(b, *at);
}

double betweenLineAndArc(const ContourElement &line, const ContourElement &arc) {
  const Vector direction = line.direction(line.from), foot = footOn(line, arc.centre);
  const Vector towards = foot - arc.centre;
  const double off = towards.norm(), radius = arc.radius();
  if (off >= radius) {
    const Vector at = arc.centre + towards * (radius / off);
    return spans(line, foot) && spans(arc, at) ? off - radius
                                               : std::numeric_limits<double>::infinity();
  }
  const Vector half = direction * std::sqrt(radius * radius - off * off);
  for (const Vector &at : {Vector(foot + half), Vector(foot - half)})
    if (spans(line, at) && spans(arc, at))
      return 0;
  return std::numeric_limits<double>::infinity();
}

double betweenArcs(const ContourElement &a, const ContourElement &b) {
  const Vector between = b.centre - a.centre;
  const double apart = between.norm(), r = a.radius(), s = b.radius();
  double least = std::numeric_limits<double>::infinity();
  if (apart == 0)
    return least; // their ends are as close as any other points
  const Vector unit = between / apart;
  for (const double i : {r, -r})
    for (const double k : {s, -s}) {
      const Vector p = a.centre + unit * i, q = b.centre + unit * k;
      if (spans(a, p) && spans(b, q))
        least = std::min(least, (p - q).norm());
    }
  const double along = (r * r - s * s + apart * apart) / (2 * apart);
  const double square = r * r - along * along;
  if (square < 0)
    return least;
  const Vector foot = a.centre + unit * along, half = leftOf(unit) * std::sqrt(square);
  for (const Vector &at : {Vector(foot + half), Vector(foot - half)})
    if (spans(a, at) && spans(b, at))
      return 0;
  return least;
}

} // namespace

Box boxOf(const ContourElement &element) {
  if (!element.arc)
    return {element.from.cwiseMin(element.to), element.from.cwiseMax(element.to)};
  const Vector reach = Vector::Constant(element.radius());
  return {element.centre - reach, element.centre + reach};
}

double gapBetween(const Box &a, const Box &b) {
  const Vector gap = (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0);
  return gap.norm();
}

double distanceBetween(const ContourElement &a, const ContourElement &b) {
  double least = std::min(
      {distanceTo(a, b.from), distanceTo(a, b.to), distanceTo(b, a.from), distanceTo(b, a.to)});
  if (!a.arc && !b.arc)
    return crossLines(a, b) ? 0 : least;
  return std::min(least, a.arc && b.arc ? betweenArcs(a, b)
                                        : betweenLineAndArc(a.arc ? b : a, a.arc ? a : b));
}

} // namespace ncvet
