// One line or arc of a turned contour, in the frame of the passes along it.
#include "interp/geometry/profile_piece.h"

namespace ncvet {

namespace {

/// Where the line through `line` meets the circle of `arc`, nearest to `near`.
Point lineWithCircle(const ProfilePiece &line, const ProfilePiece &arc, const Point &near) {
  const Point along = (line.to - line.from).normalized();
  const Point foot = line.from + along * along.dot(arc.centre - line.from);
  const double off = (foot - arc.centre).norm(), r = arc.radius();
  const double half = std::sqrt(std::max(0.0, r * r - off * off));
  const Point one = foot + half * along, other = foot - half * along;
  return (one - near).norm() < (other - near).norm() ? one : other;
}

} // namespace

bool ProfilePiece::isSteady() const {
  const double way = to.x() - from.x();
  if (!arc)
    return way <= ProfileLimits::turnsBack;
  const double sign = counterClockwise ? 1 : -1;
  return way <= -ProfileLimits::turnsBack &&
         sign * (from.y() - centre.y()) >= -ProfileLimits::turnsBack &&
         sign * (to.y() - centre.y()) >= -ProfileLimits::turnsBack;
}

bool ProfilePiece::spans(const Point &point) const {
  const double sign = counterClockwise ? 1 : -1;
  return sign * cross(from - centre, point - centre) >= -ProfileLimits::samePoint &&
         sign * cross(to - centre, point - centre) <= ProfileLimits::samePoint;
}

llvm::SmallVector<double, 2> ProfilePiece::at(double height) const {
  llvm::SmallVector<double, 2> places;
  if (arc) {
    const double r = radius(), off = height - centre.y();
    const double square = r * r - off * off;
    if (square < -ProfileLimits::samePoint)
      return places;
    const double half = std::sqrt(std::max(0.0, square));
    for (const double place : {centre.x() + half, centre.x() - half})
      if (spans({place, height}))
        places.push_back(place);
    return places;
  }
  const auto [low, high] = std::minmax(from.y(), to.y());
  if (low > height + ProfileLimits::samePoint || high < height - ProfileLimits::samePoint)
    return places;
  if (high - low < ProfileLimits::samePoint)
    places.append({from.x(), to.x()});
  else
    places.push_back(from.x() + (height - from.y()) / (to.y() - from.y()) * (to.x() - from.x()));
  return places;
}

void ProfilePiece::offset(double distance) {
  if (!arc) {
    const Point back = (from - to).normalized();
    const Point side = distance * Point(-back.y(), back.x());
    from += side;
    to += side;
    return;
  }
  const double factor = (radius() + (counterClockwise ? distance : -distance)) / radius();
  from = centre + factor * (from - centre);
  to = centre + factor * (to - centre);
}

bool meet(ProfilePiece &a, ProfilePiece &b) {
  if (!a.arc && !b.arc) {
    const Point u = a.to - a.from, v = b.to - b.from;
    const double turn = cross(u, v);
    if (turn == 0)
      return false;
    a.to = b.from = a.from + cross(b.from - a.from, v) / turn * u;
    return true;
  }
  if (a.arc != b.arc) {
    if ((a.to - b.from).norm() >= ProfileLimits::samePoint)
      a.to = b.from = a.arc ? lineWithCircle(b, a, b.from) : lineWithCircle(a, b, b.from);
    return true;
  }
  if (a.counterClockwise != b.counterClockwise)
    return true;
  const Point between = a.centre - b.centre;
  const double c = between.norm();
  if (c == 0)
    return true;
  const double ra = b.radius(), rb = a.radius();
  const double cosine = (c * c + ra * ra - rb * rb) / (2 * ra * c);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Point e = between / c;
  a.to = b.from =
      b.centre + ra * Point(cosine * e.x() - sine * e.y(), sine * e.x() + cosine * e.y());
  return true;
}

} // namespace ncvet
