// The elements of the compensated contour that the blocks executed so far have made.
#include "analyzer/facts/contour_trail.h"

#include "analyzer/facts/corner_words.h"
#include "interp/cycles/block_moves.h"
#include "interp/evaluate/tool_data.h"

namespace ncvet {

namespace {

uint64_t tagOf(const RuleContext &ctx) {
  return uint64_t(ctx.source().id()) << 32 | ctx.block().begin;
}

} // namespace

ContourTrail::ContourTrail(const Dialect &dialect, const MachineProfile &machine)
    : dialect_(dialect), habits_(habitsOf(dialect, machine)), corners_(dialect),
      coordinates_(dialect, plane_) {
  const CornerAddresses corners = cornerAddresses(dialect);
  cornerWords_ = corners.corner();
}

bool ContourTrail::isInPlace(const RuleContext &ctx) const {
  for (size_t i = 0; i < 2; ++i)
    if (!(ctx.before().at(plane_[i]) == programmed_[i]) ||
        ctx.before().inMachineCoordinates(plane_[i]))
      return false;
  return true;
}

bool ContourTrail::goesOn(const RuleContext &ctx) const {
  const MachineState &before = ctx.before(), &after = ctx.after();
  const bool samePlane = after.active(dialect_, StandardGroup::Plane) == planeCodes_ ||
                         planeOrder(dialect_, after) == plane_;
  const bool sameSide = after.active(dialect_, StandardGroup::Compensation) == sideCodes_ ||
                        after.activeAction(dialect_, StandardGroup::Compensation) == side_;
  return samePlane && sameSide && isInPlace(ctx) && before.compensation == phaseOn &&
         before.frames == frames_ &&
         std::array{after.tool.get(), after.toolOffset.get(), after.radiusOffset.get()} == tool_ &&
         after.commons == commons_;
}

double ContourTrail::centreLeft(const RuleContext &ctx) const {
  const auto radius = compensationRadius(dialect_, ctx.machine(), ctx.after());
  return radius && *radius != 0 ? *radius * compensatedSide(dialect_, ctx.after()) : 0;
}

void ContourTrail::begin(const RuleContext &ctx) {
  plane_ = planeOrder(dialect_, ctx.after());
  coordinates_ = ContourPlane(dialect_, plane_);
  path_.emplace(dialect_);
  incomplete_ = false;
  moves_.clear();
  appendReturn({dialect_, ctx.machine(), ctx.block(), ctx.outcome(), ctx.before(), ctx.after()},
               moves_);
  from_ = workPlace(moves_.front());
  path_->add(0, moves_.front(), {}, plane_, [](uint64_t, const Move &) {});
  planeCodes_ = ctx.after().active(dialect_, StandardGroup::Plane);
  sideCodes_ = ctx.after().active(dialect_, StandardGroup::Compensation);
  side_ = ctx.after().activeAction(dialect_, StandardGroup::Compensation);
  tool_ = {ctx.after().tool, ctx.after().toolOffset, ctx.after().radiusOffset};
  commons_ = ctx.after().commons;
  before_.reset();
  last_.reset();
  ends_ = {};
  ends_.unknownBefore = true;
  lastTag_ = 0;
}

/// `leaves`: the move off follows, on which the tool begins beside the last element's end.
void ContourTrail::end(bool leaves, Judge judge) {
  if (!path_)
    return;
  path_->finish([&](uint64_t tag, const Move &move) { add(tag, move, judge); });
  if (last_)
    judgeLast(nullptr, !leaves, judge);
  path_.reset();
}

void ContourTrail::take(const RuleContext &ctx, bool certain, Judge judge) {
  const MachineState &after = ctx.after();
  if (after.compensation != phaseOn)
    return end(!(after.compensation & phaseOn) && isInPlace(ctx), judge);
  if (path_ && !goesOn(ctx))
    end(false, judge);
  if (path_ && takePlain(ctx, certain, judge))
    return;
  const double left = path_ ? block_.element.left : centreLeft(ctx);
  if (left == 0)
    return;
  if (!path_)
    begin(ctx);
  else if (incomplete_)
    resume(ctx);
  const Block &block = ctx.block();
  const ExecutedBlock executed{dialect_, ctx.machine(), block, ctx.outcome(), ctx.before(), after};
  blockBefore_ = block_;
  block_.tag = tagOf(ctx);
  block_.element = {
      {}, ctx.blockRange(), false, certain, false, left, after.origin.of(StatePart::Tool)};
  block_.approach = ctx.before().compensation != phaseOn;
  const Word *corner = block.hasAny(cornerWords_) ? block.findAny(cornerWords_) : nullptr;
  block_.cornerRange = corner ? ctx.range(*corner) : block_.element.range;
  moves_.clear();
  appendMoves(executed, moves_);
  const CornerRequest request = corners_.read(executed);
  for (const Move &move : moves_)
    path_->add(block_.tag, move, request, plane_,
               [&](uint64_t tag, const Move &m) { add(tag, m, judge); });
  frames_ = after.frames;
  keepPlace(ctx);
}

void ContourTrail::keepPlace(const RuleContext &ctx) {
  for (size_t i = 0; i < 2; ++i)
    programmed_[i] = ctx.after().at(plane_[i]);
}

/// A straight move without corner words, by far the most of a long contour: its element is told by
/// the state alone.
bool ContourTrail::takePlain(const RuleContext &ctx, bool certain, Judge judge) {
  if (!ctx.outcome().plainMove || !path_->isIdle() || !frames_.empty())
    return false;
  std::array<Interval, 2> start;
  Vector from, to;
  for (size_t i = 0; i < 2; ++i) {
    const Interval &end = ctx.after().at(plane_[i]);
    start[i] = ctx.before().at(plane_[i]);
    if (!start[i].isConstant() || !end.isConstant())
      return false;
    from(int(i)) = start[i].value() / dialect_.lengthsPerUnit(plane_[i]);
    to(int(i)) = end.value() / dialect_.lengthsPerUnit(plane_[i]);
  }
  const double length = (to - from).norm();
  constexpr double shortest = 1e-6; // mm; what is no element is left to the path
  if (length < shortest)
    return false;
  incomplete_ = true;
  plainFrom_ = start;
  lastTag_ = tagOf(ctx);
  keepPlace(ctx);
  if (ctx.outcome().events.back().motion != MotionKind::Feed && !habits_.entryAcross) {
    breakOff(false, judge);
    return true;
  }
  const Vector direction = (to - from) / length;
  append({{from, to, from, false, false},
          ctx.blockRange(),
          false,
          certain,
          false,
          block_.element.left,
          ctx.after().origin.of(StatePart::Tool)},
         direction, direction, judge);
  return true;
}

/// The plain moves so far become known to the path.
void ContourTrail::resume(const RuleContext &ctx) {
  moves_.clear();
  appendReturn({dialect_, ctx.machine(), ctx.block(), ctx.outcome(), ctx.before(), ctx.after()},
               moves_);
  Move &last = moves_.front();
  last.kind = MoveKind::Linear;
  from_ = workPlace(last);
  Place begin = from_;
  for (size_t i = 0; i < 2; ++i)
    begin[size_t(plane_[i])] = plainFrom_[i];
  path_->resume(begin, last);
  incomplete_ = false;
}

void ContourTrail::add(uint64_t tag, const Move &move, Judge judge) {
  if (move.kind > MoveKind::Thread)
    return;
  const ContourPlane &plane = coordinates_;
  const auto from = plane.point(from_), to = plane.point(move.to);
  const bool inPlace = from && to && move.kind != MoveKind::Arc && *from == *to;
  const auto line = plane.element(from_, move);
  from_ = workPlace(move);
  const BlockElements &block = tag == block_.tag ? block_ : blockBefore_;
  if (inPlace)
    return;
  const bool straight =
      move.kind == MoveKind::Linear || (move.kind == MoveKind::Rapid && habits_.entryAcross);
  const bool cuts = straight || (move.kind == MoveKind::Arc && move.plane == plane_);
  // An arc that builds compensation up is another one than is programmed.
  const bool entry = block.approach && habits_.entryAcross && straight;
  if ((block.approach && !entry) || !line || !cuts)
    return breakOff(block.approach && !habits_.entryAcross, judge);
  Element element = block.element;
  element.entry = entry;
  element.line = *line;
  element.corner = tag == lastTag_;
  if (element.corner)
    element.range = block.cornerRange;
  lastTag_ = tag;
  append(element, line->direction(line->from), line->direction(line->to), judge);
}

/// Something is here that is no element: the path on, or a move that is not known.
void ContourTrail::breakOff(bool approach, Judge judge) {
  if (last_)
    judgeLast(nullptr, true, judge);
  before_.reset();
  last_.reset();
  ends_ = {};
  ends_.unknownBefore = !approach;
}

/// The corner between the last element and `next`, which begins in the direction `in`.
CornerFit ContourTrail::cornerTo(const ContourElement &next, const Vector &in, double left) const {
  return fitCorner(last_->line, next, lastOut_, in, left, habits_.straight);
}

/// `in`, `out`: directions of travel at the element's ends.
void ContourTrail::append(const Element &element, const Vector &in, const Vector &out,
                          Judge judge) {
  if (last_) {
    ends_.end = cornerTo(element.line, in, element.left);
    judgeLast(&element.line, false, judge);
    before_ = last_->line;
    ends_.begin = ends_.end;
    ends_.unknownBefore = false;
  }
  last_ = element;
  lastOut_ = out;
}

/// `after`: the element after it, null when there is none or it is not known.
void ContourTrail::judgeLast(const ContourElement *after, bool unknownAfter, Judge judge) {
  if (!after)
    ends_.end = {};
  ends_.unknownAfter = unknownAfter;
  judge(*last_, {before_ ? &*before_ : nullptr, after, ends_.unknownBefore, unknownAfter}, ends_);
}

} // namespace ncvet
