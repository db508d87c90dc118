// The contour of a turned part as pieces that rise or fall steadily, and where levels cut it.
#include "interp/geometry/turned_contour.h"

#include "interp/geometry/circle.h"

#include <algorithm>

namespace ncvet {

namespace {
constexpr double contourTolerance = 1e-7; ///< mm

/// Where the move ends; none when a coordinate is not known.
std::optional<Point> endAsTurned(const Move &move, double lengthsOfX) {
  const Interval &x = move.to[size_t(Axis::X)], &z = move.to[size_t(Axis::Z)];
  if (!x.isConstant() || !z.isConstant())
    return std::nullopt;
  return Point{z.value(), x.value() / lengthsOfX};
}
} // namespace

Point ContourPiece::at(size_t axis, double value) const {
  const size_t other = 1 - axis;
  Point point;
  point[axis] = value;
  if (arc) {
    const double off = value - centre[axis];
    point[other] =
        centre[other] + side[other] * std::sqrt(std::max(0.0, radius * radius - off * off));
  } else {
    const double way = to[axis] - from[axis];
    point[other] = std::fabs(way) < contourTolerance
                       ? to[other]
                       : from[other] + (to[other] - from[other]) * (value - from[axis]) / way;
  }
  return point;
}

TurnedContour::TurnedContour(llvm::ArrayRef<Move> moves, double lengthsOfX) {
  if (moves.empty())
    return;
  auto from = endAsTurned(moves.front(), lengthsOfX);
  for (const Move &move : moves.drop_front()) {
    const auto to = endAsTurned(move, lengthsOfX);
    if (!from || !to)
      return;
    const size_t before = pieces_.size();
    add(*from, move, lengthsOfX);
    if (move.kind == MoveKind::Arc && pieces_.size() == before)
      return; // its centre is not known
    from = to;
  }
  known_ = !pieces_.empty();
}

void TurnedContour::add(const Point &from, const Move &move, double lengthsOfX) {
  const Point to = *endAsTurned(move, lengthsOfX);
  if (move.kind == MoveKind::Arc)
    return addArc(from, to, move, lengthsOfX);
  ContourPiece &piece = pieces_.emplace_back();
  piece.from = from;
  piece.to = to;
}

void TurnedContour::addArc(const Point &from, const Point &to, const Move &move,
                           double lengthsOfX) {
  const bool swapped = move.plane[0] == Axis::X && move.plane[1] == Axis::Z;
  const bool turned = move.plane[0] == Axis::Z && move.plane[1] == Axis::X;
  const Interval &z = move.centre[swapped ? 1 : 0], &x = move.centre[swapped ? 0 : 1];
  if ((!swapped && !turned) || !z.isConstant() || !x.isConstant() || !move.turns.isConstant() ||
      move.turns.value() > 1)
    return;
  const Point centre{z.value(), x.value() / lengthsOfX};
  const double radius = distance(centre, from);
  const bool clockwise = move.clockwise != swapped;
  const double begin = angleOf(from - centre);
  const double sign = clockwise ? -1 : 1;
  const double end = begin + sign * move.turns.value() * fullTurn;
  constexpr double sameAngle = 1e-9;
  double angle = begin;
  Point at = from;
  while ((end - angle) * sign > sameAngle) {
    const double count = std::floor(angle / quarterTurn * sign + 1 + sameAngle);
    double next = count * quarterTurn * sign;
    const bool last = (next - end) * sign > -sameAngle;
    if (last)
      next = end;
    ContourPiece &piece = pieces_.emplace_back();
    piece.from = at;
    piece.to = last ? to : pointOnCircle(centre, radius, next);
    piece.arc = true;
    piece.centre = centre;
    piece.radius = radius;
    const Vector towards = unitVector((angle + next) / 2);
    piece.side = {towards.x() < 0 ? -1.0 : 1.0, towards.y() < 0 ? -1.0 : 1.0};
    piece.clockwise = clockwise;
    at = piece.to;
    angle = next;
  }
}

bool TurnedContour::isSteady(size_t axis) const {
  double sign = 0;
  for (const ContourPiece &piece : pieces_) {
    const double way = piece.to[axis] - piece.from[axis];
    if (std::fabs(way) < contourTolerance)
      continue;
    if (sign * way < 0)
      return false;
    sign = way;
  }
  return true;
}

TurnedContour::Part TurnedContour::whole() const {
  return {first(), last(), 0, pieces_.size() - 1, true, true};
}

llvm::SmallVector<TurnedContour::Part, 4>
TurnedContour::beyond(size_t axis, double level, double sign, const Part *within) const {
  const Part all = within ? *within : whole();
  llvm::SmallVector<Part, 4> parts;
  const auto depth = [&](const Point &point) { return (point[axis] - level) * sign; };
  bool open = depth(all.from) >= -contourTolerance;
  if (open)
    parts.push_back({all.from, all.from, all.firstPiece, all.firstPiece, all.fromBegin, false});
  for (size_t i = all.firstPiece; i <= all.lastPiece; ++i) {
    const Point to = i == all.lastPiece ? all.to : pieces_[i].to;
    const bool deep = depth(to) >= -contourTolerance;
    if (deep != open) {
      const Point crossing = pieces_[i].at(axis, level);
      if (deep)
        parts.push_back({crossing, crossing, i, i, false, false});
      parts.back().to = crossing;
      parts.back().lastPiece = i;
      open = deep;
    }
  }
  if (open) {
    parts.back().to = all.to;
    parts.back().lastPiece = all.lastPiece;
    parts.back().toEnd = all.toEnd;
  }
  return parts;
}

double TurnedContour::farthest(size_t axis, double sign, const Part &part) const {
  double result = part.from[axis];
  const auto take = [&](double value) {
    if ((value - result) * sign > 0)
      result = value;
  };
  for (size_t i = part.firstPiece; i < part.lastPiece; ++i)
    take(pieces_[i].to[axis]);
  take(part.to[axis]);
  return result;
}

void TurnedContour::shift(const Point &by) {
  for (ContourPiece &piece : pieces_)
    for (Point *point : {&piece.from, &piece.to, &piece.centre})
      *point += by;
}

} // namespace ncvet
