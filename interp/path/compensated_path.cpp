// Puts radius compensation into a path: the motions of the tool's centre.
#include "interp/path/compensated_path.h"

#include <utility>

namespace ncvet {

namespace {

bool isTravel(const Move &move) { return move.kind <= MoveKind::Thread; }

Vector beside(const ContourElement &element, const Vector &at, double left) {
  return at + leftOf(element.direction(at)) * left;
}

/// The point of a circle that lies towards `point`.
Vector footOnCircle(const Vector &centre, const Vector &point, double radius) {
  return centre + (point - centre).normalized() * radius;
}

} // namespace

CompensationHabits habitsOf(const Dialect &dialect, const MachineProfile &machine) {
  const auto said = [&](const char *name) -> llvm::StringRef {
    if (const auto own = machine.option(name))
      return *own;
    const auto usual = dialect.options.find(name);
    return usual == dialect.options.end() ? llvm::StringRef() : llvm::StringRef(usual->second);
  };
  CompensationHabits habits;
  habits.outside = said("outsideCorner") == "lines"         ? OutsideCorner::Lines
                   : said("outsideCorner") == "arc-of-next" ? OutsideCorner::ArcOfNext
                                                            : OutsideCorner::Arc;
  habits.entryAcross = said("compensationEntry") == "across";
  said("straightCorner").getAsDouble(habits.straight);
  return habits;
}

/// The move ends at `end` in its plane.
void CompensatedPath::give(Tagged &tagged, const Vector &end, Take take) {
  const ContourPlane plane(dialect_, tagged.move.plane);
  plane.set(tagged.move.to, end);
  if (tagged.move.kind == MoveKind::Arc) {
    plane.retrim(tagged.move, centre_);
    if (tagged.move.turns.isConstant())
      tagged.move.turns = Interval::exactly(tagged.move.turns.value() + furtherTurns_);
  }
  centre_ = workPlace(tagged.move);
  take(tagged.tag, tagged.move);
}

/// What was after the waiting move happens where that one ends.
void CompensatedPath::flush(Take take) {
  for (Tagged &tagged : between_) {
    if (isTravel(tagged.move)) {
      for (const Axis axis : tagged.move.plane)
        tagged.move.to[size_t(axis)] = centre_[size_t(axis)];
      centre_ = workPlace(tagged.move);
    }
    take(tagged.tag, tagged.move);
  }
  between_.clear();
  waiting_.reset();
  element_.reset();
}

/// Round an outside corner along straight lines: on to where the paths beside the two elements
/// meet, or to a point of each when that would be far away.
void CompensatedPath::goAlongLines(const ContourElement &next, Take take) {
  const Vector in = element_->direction(element_->to), out = next.direction(next.from);
  const double turn = std::fabs(angleBetween(in, out));
  const double on = reachOfCorner(std::fabs(left_), std::min(turn, quarterTurn));
  const Vector end = beside(*element_, element_->to, left_), goal = beside(next, next.from, left_);
  Tagged line = *waiting_;
  if (line.move.kind == MoveKind::Arc) {
    give(*waiting_, end, take);
    line.move.kind = MoveKind::Linear;
  }
  give(line, end + in * on, take);
  if (turn > quarterTurn)
    give(line, goal - out * on, take);
  if (next.arc)
    give(line, goal, take);
}

/// Round the outside corner at the end of `element`, by a move like `like`.
void CompensatedPath::goRound(const ContourElement &element, const ContourElement &next,
                              const Tagged &like, Take take) {
  const Vector goal = beside(next, next.from, left_);
  const ContourPlane plane(dialect_, like.move.plane);
  Move move = like.move;
  for (unsigned i = 0; i < unsigned(Axis::A); ++i) // other axes turn by the corner's block
    move.to[i] = centre_[i];
  if (move.kind == MoveKind::Rapid)
    plane.set(move.to, goal);
  else
    move = plane.arc(move, {beside(element, element.to, left_), goal, element.to, true, left_ > 0});
  centre_ = workPlace(move);
  take(like.tag, move);
}

/// Whether the control takes the waiting element and `next` for one line.
bool CompensatedPath::isStraight(const ContourElement &next) const {
  if (habits_.straight <= 0)
    return false;
  const Vector in = element_->direction(element_->to), out = next.direction(next.from);
  return std::fabs(angleBetween(in, out)) <= habits_.straight;
}

/// The waiting move ends where the path beside `next`, the element of `after`, begins.
void CompensatedPath::meet(const ContourElement &next, const Tagged &after, Take take) {
  if (!element_) {
    give(*waiting_, beside(next, next.from, left_), take);
    return flush(take);
  }
  const Vector end = beside(*element_, element_->to, left_);
  if (isStraight(next)) {
    give(*waiting_, end, take);
    return flush(take);
  }
  ContourElement ending = *element_;
  if (ending.arc) // its ends may lie on two circles: here the one of its end counts
    ending.from = footOnCircle(ending.centre, ending.from, (ending.to - ending.centre).norm());
  const CornerFit fit = fitCorner(ending, next, ending.direction(ending.to),
                                  next.direction(next.from), left_, habits_.straight);
  const bool outside = fit.kind == CornerFit::Kind::Outside;
  if (outside && habits_.outside == OutsideCorner::ArcOfNext) {
    const ContourElement element = *element_;
    give(*waiting_, end, take);
    flush(take);
    return goRound(element, next, after, take);
  }
  if (outside &&
      (habits_.outside == OutsideCorner::Lines || waiting_->move.kind == MoveKind::Rapid)) {
    goAlongLines(next, take);
    return flush(take);
  }
  const bool meets = fit.kind == CornerFit::Kind::Inside || fit.kind == CornerFit::Kind::Smooth;
  give(*waiting_, meets ? fit.meet : end, take);
  if (outside)
    goRound(*element_, next, *waiting_, take);
  flush(take);
}

/// The element to which a path on that ends square to itself belongs: an arc of which the tool's
/// centre follows the path beside it from where it is.
std::optional<ContourElement>
CompensatedPath::entryOf(const std::optional<ContourElement> &element) const {
  if (!habits_.entryAcross || !element || !element->arc)
    return habits_.entryAcross ? element : std::nullopt;
  // Programmed is the arc's end and its direction there; it leads through the tool's centre.
  const Vector end = beside(*element, element->to, left_), chord = element->from - end;
  const Vector inward = (element->centre - element->to).normalized();
  const double along = inward.dot(chord);
  if (along == 0)
    return std::nullopt;
  ContourElement entry = *element;
  entry.centre = end + inward * (chord.squaredNorm() / (2 * along));
  entry.from = footOnCircle(entry.centre, element->from, (entry.to - entry.centre).norm());
  return entry;
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
      between_.push_back({tag, move});
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
    between_.push_back({tag, move}); // along the tool's axis only
    return;
  }
  const bool wasOn = std::exchange(on_, left != 0);
  if (left == 0 || !to || (wasOn && !element)) {
    finish(take);
    Move plain = move;
    for (size_t i = 0; i < 2 && left != 0; ++i) // where the path beside it ends is not known
      plain.to[size_t(move.plane[i])] = plain.centre[i] = Interval::unknown();
    centre_ = workPlace(plain);
    take(tag, plain);
    return;
  }
  if (!wasOn) { // it ends beside the begin of the next one
    finish(take);
  } else if (waiting_) {
    left_ = left;
    meet(*element, {tag, move}, take);
  }
  left_ = left;
  waiting_ = {tag, move};
  element_ = wasOn ? element : entryOf(element);
  furtherTurns_ = 0;
  if (move.kind == MoveKind::Arc && element && move.turns.isConstant())
    furtherTurns_ = std::round(move.turns.value() - turnsAround(element->centre, element->from,
                                                                element->to, element->clockwise));
  if (element_ && element_->arc && !wasOn)
    waiting_->move = plane.arc(move, *element_);
}

} // namespace ncvet
