// Puts radius compensation into a path: the motions of the tool's centre.
#include "interp/compensated_path.h"

#include <cmath>
#include <numbers>
#include <utility>

namespace ncvet {

namespace {

bool isTravel(const Move &move) { return move.kind <= MoveKind::Thread; }

Vector beside(const ContourElement &element, const Vector &at, double left) {
  return at + leftOf(element.direction(at)) * left;
}

} // namespace

/// The move ends at `end` in its plane.
void CompensatedPath::give(Tagged &tagged, const Vector &end, Take take) {
  const ContourPlane plane(dialect_, tagged.move.plane);
  plane.set(tagged.move.to, end);
  if (tagged.move.kind == MoveKind::Arc)
    plane.retrim(tagged.move, centre_);
  centre_ = workPlace(tagged.move);
  take(tagged.tag, tagged.move);
}

/// What stood behind the waiting move happens where that one ends.
void CompensatedPath::flush(Take take) {
  for (Tagged &tagged : behind_) {
    if (isTravel(tagged.move)) {
      for (const Axis axis : tagged.move.plane)
        tagged.move.to[size_t(axis)] = centre_[size_t(axis)];
      centre_ = workPlace(tagged.move);
    }
    take(tagged.tag, tagged.move);
  }
  behind_.clear();
  waiting_.reset();
  element_.reset();
}

/// Round an outside corner along straight lines: on to where the ways beside the two elements meet,
/// or to a point of each when that would be far away.
void CompensatedPath::goAlongLines(const ContourElement &next, Take take) {
  constexpr double square = std::numbers::pi / 4;
  const Vector in = element_->direction(element_->to), out = next.direction(next.from);
  const double half = std::atan2(std::fabs(cross(in, out)), in.dot(out)) / 2;
  const double on = std::fabs(left_) * std::tan(std::min(half, square));
  const Vector end = beside(*element_, element_->to, left_), goal = beside(next, next.from, left_);
  Tagged line = *waiting_;
  if (line.move.kind == MoveKind::Arc) {
    give(*waiting_, end, take);
    line.move.kind = MoveKind::Linear;
  }
  give(line, end + in * on, take);
  if (half > square)
    give(line, goal - out * on, take);
  if (next.arc)
    give(line, goal, take);
}

/// The waiting move ends where the way beside `next` begins.
void CompensatedPath::meet(const ContourElement &next, Take take) {
  if (!element_) {
    give(*waiting_, beside(next, next.from, left_), take);
    return flush(take);
  }
  const CornerFit fit = fitCorner(*element_, next, left_);
  const bool outside = fit.kind == CornerFit::Kind::Outside;
  if (outside && (corners_ == OutsideCorner::Lines || waiting_->move.kind == MoveKind::Rapid)) {
    goAlongLines(next, take);
    return flush(take);
  }
  const bool meets = fit.kind == CornerFit::Kind::Inside || fit.kind == CornerFit::Kind::Smooth;
  give(*waiting_, meets ? fit.meet : beside(*element_, element_->to, left_), take);
  if (outside) {
    const ContourPlane plane(dialect_, waiting_->move.plane);
    const Move round =
        plane.arc(waiting_->move, {beside(*element_, element_->to, left_),
                                   beside(next, next.from, left_), element_->to, true, left_ > 0});
    centre_ = workPlace(round);
    take(waiting_->tag, round);
  }
  flush(take);
}

void CompensatedPath::finish(Take take) {
  if (!waiting_)
    return;
  if (element_)
    give(*waiting_, beside(*element_, element_->to, left_), take);
  else
    take(waiting_->tag, waiting_->move);
  flush(take);
}

void CompensatedPath::add(uint64_t tag, const Move &move, Take take) {
  if (!isTravel(move)) {
    if (waiting_)
      behind_.push_back({tag, move});
    else
      take(tag, move);
    return;
  }
  const double left = move.side * move.toolRadius.value_or(0);
  const ContourPlane plane(dialect_, move.plane);
  const auto from = plane.point(programmed_), to = plane.point(move.to);
  const auto element = left != 0 ? plane.element(programmed_, move) : std::nullopt;
  programmed_ = workPlace(move);
  if (left != 0 && waiting_ && from && to && move.kind != MoveKind::Arc && *from == *to) {
    behind_.push_back({tag, move}); // along the tool's axis only
    return;
  }
  const bool wasOn = std::exchange(on_, left != 0);
  if (left == 0 || !to || (wasOn && !element)) {
    finish(take);
    Move plain = move;
    for (size_t i = 0; i < 2 && left != 0; ++i) // where the way beside it ends is not known
      plain.to[size_t(move.plane[i])] = plain.centre[i] = Interval::unknown();
    centre_ = workPlace(plain);
    take(tag, plain);
    return;
  }
  if (!wasOn) { // it ends beside the begin of the next one
    finish(take);
  } else if (waiting_) {
    left_ = left;
    meet(*element, take);
  }
  waiting_ = {tag, move};
  element_ = wasOn ? element : std::nullopt;
  left_ = left;
}

} // namespace ncvet
