// The elements of the compensated contour that the blocks executed so far have made.
#include "analyzer/contour_trail.h"

#include "analyzer/corner_words.h"
#include "interp/tool_data.h"

namespace ncvet {

ContourTrail::ContourTrail(const Dialect &dialect)
    : dialect_(dialect), corners_(dialect), coordinates_(dialect, plane_) {
  const CornerAddresses corners = cornerAddresses(dialect);
  cornerWords_ = corners.corner();
}

bool ContourTrail::isInPlace(const RuleContext &ctx) const {
  for (const Axis axis : plane_)
    if (!(ctx.before().at(axis) == programmed_[size_t(axis)]) ||
        ctx.before().inMachineCoordinates(axis))
      return false;
  return true;
}

bool ContourTrail::goesOn(const RuleContext &ctx) const {
  const MachineState &after = ctx.after();
  return isInPlace(ctx) && ctx.before().compensation == phaseOn && ctx.before().frames == frames_ &&
         planeOrder(dialect_, after) == plane_ &&
         after.activeAction(dialect_, StandardGroup::Compensation) == side_ &&
         std::array{after.tool, after.toolOffset, after.radiusOffset} == tool_ &&
         after.commons == commons_;
}

double ContourTrail::centreLeft(const RuleContext &ctx) const {
  const auto radius = compensationRadius(dialect_, ctx.machine(), ctx.after());
  return radius.value_or(0) * compensatedSide(dialect_, ctx.after());
}

void ContourTrail::begin(const RuleContext &ctx) {
  plane_ = planeOrder(dialect_, ctx.after());
  coordinates_ = ContourPlane(dialect_, plane_);
  path_.emplace(dialect_);
  moves_.clear();
  appendReturn({dialect_, ctx.machine(), ctx.block(), ctx.outcome(), ctx.before(), ctx.after()},
               moves_);
  from_ = workPlace(moves_.front());
  path_->add(0, moves_.front(), {}, plane_, [](uint64_t, const Move &) {});
  side_ = ctx.after().activeAction(dialect_, StandardGroup::Compensation);
  tool_ = {ctx.after().tool, ctx.after().toolOffset, ctx.after().radiusOffset};
  commons_ = ctx.after().commons;
  before_.reset();
  last_.reset();
  unknownBefore_ = true;
  lastTag_ = 0;
}

/// `leaves`: the way off follows, on which the tool begins beside the last element's end.
void ContourTrail::end(bool leaves, Judge judge) {
  if (!path_)
    return;
  path_->finish([&](uint64_t tag, const Move &move) { add(tag, move, judge); });
  if (last_)
    judge(*last_, {before_ ? &before_->line : nullptr, nullptr, unknownBefore_, !leaves});
  path_.reset();
}

void ContourTrail::take(const RuleContext &ctx, bool certain, Judge judge) {
  const MachineState &after = ctx.after();
  if (after.compensation != phaseOn)
    return end(!(after.compensation & phaseOn) && isInPlace(ctx), judge);
  if (path_ && !goesOn(ctx))
    end(false, judge);
  const double left = path_ ? block_.element.left : centreLeft(ctx);
  if (left == 0)
    return;
  if (!path_)
    begin(ctx);
  const Block &block = ctx.block();
  const ExecutedBlock executed{dialect_, ctx.machine(), block, ctx.outcome(), ctx.before(), after};
  blockBefore_ = block_;
  block_.tag = uint64_t(ctx.source().id()) << 32 | block.begin;
  block_.element = {{}, ctx.blockRange(), false, certain, left, after.origin.tool};
  block_.approach = ctx.before().compensation != phaseOn;
  const Word *corner = block.hasAny(cornerWords_) ? block.findAny(cornerWords_) : nullptr;
  block_.cornerRange = corner ? ctx.range(*corner) : block_.element.range;
  moves_.clear();
  appendMoves(executed, moves_);
  const CornerRequest request = corners_.read(executed);
  for (const Move &move : moves_)
    path_->add(block_.tag, move, request, plane_,
               [&](uint64_t tag, const Move &m) { add(tag, m, judge); });
  programmed_ = after.position;
  frames_ = after.frames;
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
  const bool cuts =
      move.kind == MoveKind::Linear || (move.kind == MoveKind::Arc && move.plane == plane_);
  if (block.approach || !line || !cuts) {
    if (last_)
      judge(*last_, {before_ ? &before_->line : nullptr, nullptr, unknownBefore_, true});
    before_.reset();
    last_.reset();
    unknownBefore_ = !block.approach;
    return;
  }
  Element element = block.element;
  element.line = *line;
  element.corner = tag == lastTag_;
  if (element.corner)
    element.range = block.cornerRange;
  lastTag_ = tag;
  if (last_) {
    judge(*last_, {before_ ? &before_->line : nullptr, &element.line, unknownBefore_, false});
    before_ = last_;
    unknownBefore_ = false;
  }
  last_ = element;
}

} // namespace ncvet
