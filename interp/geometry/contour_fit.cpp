// Whether a round tool that runs beside a contour reaches each of its elements.
#include "interp/geometry/contour_fit.h"

#include "interp/geometry/contour_distance.h"

#include "llvm/ADT/SmallVector.h"

#include <cmath>

namespace ncvet {

namespace {

/// Paths whose ends are closer (mm) join: points and centres are written with three digits.
constexpr double joined = 2e-3;
/// How much (mm) of a cut a radius that is told as a safe one may make.
constexpr double safe = 2e-3;
/// Radii (mm) beyond which no tool is made.
constexpr double largestTool = 500;

/// The point beside an element's end.
Vector beside(const ContourElement &element, const Vector &at, double left) {
  return at + leftOf(element.direction(at)) * left;
}

/// Length (mm) along the path beside an arc between `at` and one of its ends; below zero when `at`
/// lies beyond that end. `sense`: 1 from `at` on to `end`, -1 from `end` on to `at`.
double turnTo(const ContourElement &arc, const Vector &at, const Vector &end, double left,
              int sense) {
  const Vector a = at - arc.centre, b = end - arc.centre;
  const double angle = angleBetween(a, b) * sense;
  return (arc.clockwise ? -angle : angle) * arc.radiusBeside(left);
}

bool hasRoom(const ContourElement &element, double left) {
  return !element.arc || element.radiusBeside(left) > 0;
}

double lengthBeside(const ContourElement &element, double left) {
  return element.arc ? element.length() * element.radiusBeside(left) / element.radius()
                     : element.length();
}

/// A corner of which the paths beside its elements end at `a` and begin at `b`.
struct Corner {
  const ContourElement &first, &second;
  Vector in, out, a, b;
};

/// The paths are cut off where they meet.
void cutOff(CornerFit &fit, const Corner &at, double left, const std::optional<Vector> &meet) {
  fit.kind = meet ? CornerFit::Kind::Inside : CornerFit::Kind::Apart;
  if (!meet)
    return;
  fit.meet = *meet;
  fit.ofFirst = at.first.arc ? turnTo(at.first, *meet, at.a, left, 1) : at.in.dot(at.a - *meet);
  fit.ofSecond =
      at.second.arc ? turnTo(at.second, *meet, at.b, left, -1) : at.out.dot(*meet - at.b);
}

} // namespace

CornerFit fitCorner(const ContourElement &first, const ContourElement &second, double left) {
  return fitCorner(first, second, first.direction(first.to), second.direction(second.from), left);
}

CornerFit fitCorner(const ContourElement &first, const ContourElement &second, const Vector &in,
                    const Vector &out, double left) {
  CornerFit fit;
  if (!hasRoom(first, left) || !hasRoom(second, left))
    return fit;
  const Vector a = first.to + leftOf(in) * left, b = second.from + leftOf(out) * left;
  const double sine = cross(in, out), cosine = in.dot(out);
  fit.sine = std::fabs(sine);
  if (cosine > 0 && (a - b).squaredNorm() <= joined * joined) {
    fit.kind = CornerFit::Kind::Smooth;
    fit.meet = (a + b) / 2;
    return fit;
  }
  if (sine * left <= 0 || cosine <= -1 + 1e-12) {
    fit.kind = CornerFit::Kind::Outside;
    // The tangent of half the angle; corners sharper than a square get further points.
    fit.gain = std::fabs(left) * (cosine > 0 ? fit.sine / (1 + cosine) : 1);
    return fit;
  }
  const bool lines = !first.arc && !second.arc;
  cutOff(fit, {first, second, in, out, a, b}, left,
         lines ? intersection(a, in, b, out) : meetingBeside(first, second, left, first.to));
  return fit;
}

CornerFit fitCorner(const ContourElement &first, const ContourElement &second, const Vector &in,
                    const Vector &out, double left, double nearly) {
  CornerFit fit = fitCorner(first, second, in, out, left);
  if (nearly <= 0 || fit.kind == CornerFit::Kind::None || fit.sine > std::sin(nearly))
    return fit;
  if (in.dot(out) > 0) {
    fit.kind = CornerFit::Kind::Smooth;
    return fit;
  }
  const ContourElement &round = second.arc ? second : first;
  if (round.arc && round.clockwise == (left > 0)) {
    const Vector further = first.to + out * std::fabs(left); // nearer to the one of two meetings
    cutOff(fit,
           {first, second, in, out, first.to + leftOf(in) * left, second.from + leftOf(out) * left},
           left, meetingBeside(first, second, left, further));
  } else {
    fit.kind = CornerFit::Kind::Outside;
    fit.gain = std::fabs(left);
  }
  return fit;
}

Misfit misfit(const ContourElement &element, const Neighbours &neighbours, double left, bool exact,
              double slack) {
  ElementCorners corners{{}, {}, neighbours.unknownBefore, neighbours.unknownAfter};
  if (neighbours.before)
    corners.begin = fitCorner(*neighbours.before, element, left);
  if (neighbours.after)
    corners.end = fitCorner(element, *neighbours.after, left);
  return misfit(element, corners, left, exact, slack);
}

Misfit misfit(const ContourElement &element, const ElementCorners &corners, double left, bool exact,
              double slack) {
  constexpr double rounding = 1e-9;
  if (element.arc && element.radiusBeside(left) < (slack > 0 ? -joined : rounding))
    return Misfit::Arc;
  if (!hasRoom(element, left))
    return Misfit::Fits; // as round as the tool: it is still there
  using Kind = CornerFit::Kind;
  const CornerFit &begin = corners.begin, &end = corners.end;
  if (end.kind == Kind::Apart)
    return Misfit::Corner;
  if (begin.kind != Kind::Inside && end.kind != Kind::Inside)
    return Misfit::Fits;
  const double taken = (begin.kind == Kind::Inside ? begin.ofSecond : 0) +
                       (end.kind == Kind::Inside ? end.ofFirst : 0);
  double way = lengthBeside(element, left);
  if (!exact)
    way +=
        (begin.kind == Kind::Outside ? begin.gain : 0) + (end.kind == Kind::Outside ? end.gain : 0);
  // As much as a corner at an unknown end may give.
  way += std::fabs(left) * (int(corners.unknownBefore) + int(corners.unknownAfter));
  const double back = taken - way; // the tool runs back so far, into what its neighbours cut
  const double sine = std::max(begin.kind == Kind::Inside ? begin.sine : 0,
                               end.kind == Kind::Inside ? end.sine : 0);
  return back * sine > slack ? Misfit::Element : Misfit::Fits;
}

namespace {

/// The paths beside a contour, cut off in its inside corners, with the arcs round its outside ones.
llvm::SmallVector<std::pair<size_t, ContourElement>, 0>
waysBeside(llvm::ArrayRef<ContourElement> contour, double left) {
  llvm::SmallVector<std::pair<size_t, ContourElement>, 0> ways;
  using Kind = CornerFit::Kind;
  CornerFit begin;
  for (size_t i = 0; i < contour.size(); ++i) {
    const ContourElement &element = contour[i];
    const CornerFit end =
        i + 1 < contour.size() ? fitCorner(element, contour[i + 1], left) : CornerFit();
    if (hasRoom(element, left)) {
      ContourElement way = element;
      way.from = begin.kind == Kind::Inside ? begin.meet : beside(element, element.from, left);
      way.to = end.kind == Kind::Inside ? end.meet : beside(element, element.to, left);
      ways.push_back({i, way});
      if (end.kind == Kind::Outside)
        ways.push_back({i,
                        {way.to, beside(contour[i + 1], contour[i + 1].from, left), element.to,
                         true, left > 0}});
    }
    begin = end;
  }
  return ways;
}

bool fitsAlone(llvm::ArrayRef<ContourElement> contour, double left) {
  for (size_t i = 0; i < contour.size(); ++i)
    if (misfit(contour[i],
               {i ? &contour[i - 1] : nullptr, i + 1 < contour.size() ? &contour[i + 1] : nullptr},
               left, false, safe) != Misfit::Fits)
      return false;
  return true;
}

/// Whether the tool stays clear of all elements that are not next to the one it cuts.
bool staysClear(llvm::ArrayRef<ContourElement> contour, double left) {
  constexpr size_t ends = 2;
  if (contour.size() <= 2 * ends)
    return true;
  const double radius = std::fabs(left);
  for (const auto &[i, way] : waysBeside(contour, left)) {
    const Box box = boxOf(way);
    for (size_t k = ends; k + ends < contour.size(); ++k)
      if ((k + 1 < i || k > i + 1) && gapBetween(box, boxOf(contour[k])) < radius - safe &&
          distanceBetween(way, contour[k]) < radius - safe)
        return false;
  }
  return true;
}

/// Largest radius for which `fits` holds, which it does for all smaller ones.
template <typename Fits>
std::optional<double> largest(Fits fits) {
  if (fits(largestTool))
    return std::nullopt;
  double low = 0, high = largestTool;
  constexpr double exactly = 1e-4; // mm
  while (high - low > exactly) {
    const double middle = (low + high) / 2;
    (fits(middle) ? low : high) = middle;
  }
  return low;
}

} // namespace

std::optional<double> largestFit(llvm::ArrayRef<ContourElement> contour, bool onLeft) {
  // Each element is looked at with each: beyond this many only neighbours are.
  constexpr size_t mostCompared = 1000;
  const double sign = onLeft ? 1 : -1;
  auto alone = largest([&](double radius) { return fitsAlone(contour, sign * radius); });
  if (contour.size() > mostCompared || staysClear(contour, sign * alone.value_or(largestTool)))
    return alone;
  return largest([&](double radius) {
    return (!alone || radius <= *alone) && staysClear(contour, sign * radius);
  });
}

std::optional<double> largestFit(const ContourElement &element, const Neighbours &neighbours,
                                 bool onLeft, bool exact) {
  return largest([&](double radius) {
    return misfit(element, neighbours, onLeft ? radius : -radius, exact, safe) == Misfit::Fits;
  });
}

} // namespace ncvet
