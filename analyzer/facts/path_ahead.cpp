// The path after the current block, followed in the text for rules that look at two elements.
#include "analyzer/facts/path_ahead.h"

#include "interp/geometry/line.h"
#include "interp/path/arc_block.h"

#include <cmath>
#include <limits>

namespace ncvet {

namespace {

/// Blocks without a move that may be between two elements.
constexpr unsigned blocksBetween = 3;
constexpr double shortest = 1e-6; // mm

/// Whether what comes after the block runs in the state that the block leaves.
bool goesOn(const Outcome &outcome) {
  if (outcome.callsModally != Truth::No || outcome.flow.macro)
    return false;
  switch (outcome.flow.kind) {
  case FlowKind::Next:
  case FlowKind::Call:
  case FlowKind::CallLocal:
  case FlowKind::Return:
    return true;
  case FlowKind::Jump:
    return outcome.flow.condition == Truth::Yes;
  default:
    return false;
  }
}

} // namespace

bool keepsLengths(const FrameStack &frames) {
  if (frames.empty())
    return true;
  const auto total = frames.total();
  return total && total->keepsLengths();
}

namespace {

/// The block's only move, when it stays in its plane and in its coordinates; else null.
const Event *moveInPlane(const ExecutedBlock &executed) {
  const Dialect &dialect = executed.dialect;
  const MachineState &before = executed.before, &after = executed.after;
  const uint16_t plane = planeAxes(dialect, after);
  // A control that mills and turns may read X as a diameter there, unless the program says it.
  if (!dialect.isLathe() && dialect.group(StandardGroup::Diameter) != noGroup &&
      planeOrder(dialect, after)[0] == Axis::Z &&
      after.active(dialect, StandardGroup::Diameter) & groupUnset)
    return nullptr;
  if (executed.outcome.kinds & bitOf(EventKind::CoordinateChange) ||
      before.profile == ProfileMode::Recorded || before.may(Fact::UnknownCode) ||
      planeAxes(dialect, before) != plane || !(before.frames == after.frames) ||
      !keepsLengths(after.frames))
    return nullptr;
  const Event *motion = nullptr;
  for (const Event &event : executed.outcome.events)
    if (event.kind == EventKind::Motion) {
      if (motion)
        return nullptr;
      motion = &event;
    }
  return motion && motion->certain && motion->code != noCode && !(motion->axes & ~plane) ? motion
                                                                                         : nullptr;
}

/// Circle of the arc that the block cuts; none when it is not known.
std::optional<Point> centreOf(const ArcWords &words, const ArcGeometry &arc, bool clockwise) {
  if (words.hasCentre())
    return arc.centre();
  if (!arc.radius || !arc.start || !arc.end)
    return std::nullopt;
  return centreByRadius(*arc.start, *arc.end, *arc.radius, clockwise);
}

} // namespace

ExecutedBlock executedBlock(const RuleContext &ctx) {
  return {ctx.dialect(), ctx.machine(), ctx.block(), ctx.outcome(), ctx.before(), ctx.after()};
}

PathAhead::PathAhead(const RuleContext &ctx)
    : dialect_(&ctx.dialect()), machine_(&ctx.machine()), ahead_(ctx),
      executor_(ctx.unit().executor()), after_(ctx.after()), ended_(!goesOn(ctx.outcome())) {}

bool PathAhead::next() {
  constexpr uint32_t ends = bitOf(EventKind::UnknownCode) | bitOf(EventKind::ToolChange) |
                            bitOf(EventKind::CycleStart) | bitOf(EventKind::CycleRun) |
                            bitOf(EventKind::CoordinateChange) | bitOf(EventKind::ProgramEnd);
  for (unsigned i = 0; i <= blocksBetween && !ended_;) {
    ended_ = true;
    if (!ahead_.next(block_) || !block_.items.empty() || block_.skip >= 0)
      return false;
    before_ = after_;
    executor_.execute(block_, before_, after_, outcome_);
    if (outcome_.kinds & ends)
      return false;
    ended_ = !goesOn(outcome_);
    if (outcome_.kinds & bitOf(EventKind::Motion))
      return true;
    i += outcome_.flow.kind == FlowKind::Next;
  }
  return false;
}

std::optional<StraightElement> straightElement(const ExecutedBlock &executed) {
  const Dialect &dialect = executed.dialect;
  const MachineState &before = executed.before, &after = executed.after;
  const Event *motion = moveInPlane(executed);
  if (!motion || motion->motion != MotionKind::Feed ||
      dialect.codes[motion->code].action != Action::Linear)
    return std::nullopt;
  const std::array<Axis, 2> axes = planeOrder(dialect, after);
  StraightElement result;
  for (size_t i = 0; i < 2; ++i) {
    const auto from = placeInPlane(dialect, before, axes[i]),
               to = placeInPlane(dialect, after, axes[i]);
    if (!from || !to)
      return std::nullopt;
    result.from[i] = *from;
    result.to[i] = *to;
  }
  return result.length() < shortest ? std::nullopt : std::optional(result);
}

std::optional<ContourElement> contourElementOf(const ExecutedBlock &executed) {
  if (const auto line = straightElement(executed))
    return ContourElement{line->from, line->to, Vector::Zero(), false, false};
  const Event *motion = moveInPlane(executed);
  if (!motion || !isArc(motion->motion))
    return std::nullopt;
  const bool clockwise = motion->motion == MotionKind::ArcCw;
  const ArcWords words = arcWords(executed.dialect, executed.after, executed.block);
  const ArcGeometry arc = arcGeometry(words, executed.dialect, executed.machine, executed.block,
                                      executed.before, executed.after);
  const auto centre = centreOf(words, arc, clockwise);
  if (!centre || !arc.start || !arc.end || words.angle ||
      distance(*centre, *arc.start) < shortest || distance(*centre, *arc.end) < shortest)
    return std::nullopt;
  return ContourElement{*arc.start, *arc.end, *centre, true, clockwise};
}

std::optional<Vector> directionAt(const ExecutedBlock &executed, bool end) {
  const auto element = contourElementOf(executed);
  return element ? std::optional(element->direction(end ? element->to : element->from))
                 : std::nullopt;
}

std::optional<std::array<double, 2>> takenByRounding(double radius, const ContourElement &in,
                                                     const ContourElement &out) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  const double turn = cross(in.direction(in.to), out.direction(out.from));
  if (std::fabs(turn) < parallelSine)
    return std::nullopt;
  const double left = turn > 0 ? radius : -radius;
  if ((in.arc && in.radiusBeside(left) <= 0) || (out.arc && out.radiusBeside(left) <= 0))
    return std::array{nowhere, nowhere};
  const auto centre = meetingBeside(in, out, left, in.to);
  if (!centre)
    return std::array{nowhere, nowhere};
  return std::array{lengthBetween(in, footOn(in, *centre), in.to),
                    lengthBetween(out, out.from, footOn(out, *centre))};
}

std::optional<double> takenByCorner(const CornerRequest &corner, const StraightElement &in,
                                    const StraightElement &out) {
  const Vector a = in.direction(), b = out.direction();
  const double sine = std::fabs(cross(a, b)), cosine = a.dot(b);
  if (sine < parallelSine)
    return std::nullopt;
  switch (corner.kind) {
  case CornerRequest::Kind::Rounding:
    return corner.size * sine / (1 + cosine);
  case CornerRequest::Kind::Legs:
    return corner.size;
  case CornerRequest::Kind::Across:
    return legOfChamfer(corner.size, a, b);
  case CornerRequest::Kind::None:
    break;
  }
  return std::nullopt;
}

} // namespace ncvet
