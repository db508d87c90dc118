// Looks at the block before the move, and at what the program cuts.
#include "analyzer/facts/rapid_to_chuck.h"

#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"

#include <cmath>

namespace ncvet {

namespace {

constexpr uint16_t xAxis = 1u << unsigned(Axis::X), zAxis = 1u << unsigned(Axis::Z);

/// The block before feeds along X alone, and has ended on the axis or past it.
bool hasFaced(const RuleContext &ctx) {
  Block block;
  if (!(ctx.before().at(Axis::X).hi <= 0) || !readPrevious(ctx, block) || !block.items.empty() ||
      axesOf(ctx.dialect(), block) != xAxis)
    return false;
  const CodeInfo *const motion = ctx.before().activeCode(ctx.dialect(), StandardGroup::Motion);
  return motion && motion->action == Action::Linear;
}

/// The next block feeds the tool and has no feed of its own: it is set here.
bool isForNext(const RuleContext &ctx) {
  Block next;
  return !BlocksAhead(ctx).next(next) ||
         (findCode(ctx.dialect(), next, {Action::Linear}) && !next.has(letterAddress('F')));
}

std::optional<RapidSlip> withFeed(const PlacesOfPrograms &places, const Event &event,
                                  const RuleContext &ctx) {
  const MachineState &before = ctx.before(), &after = ctx.after();
  if (!ctx.block().has(letterAddress('F')) || !ctx.find({Action::Rapid}))
    return std::nullopt;
  const Axis axis = event.axes == xAxis ? Axis::X : Axis::Z;
  const Interval &from = before.at(axis), &to = after.at(axis);
  const bool crosses = axis == Axis::X ? from.lo > 0 && to.hi <= 0 : from.lo >= 0 && to.hi < 0;
  if ((event.axes != xAxis && event.axes != zAxis) || !from.isConstant() || !to.isConstant() ||
      !crosses || (axis == Axis::Z && isForNext(ctx)) || places.of(ctx).fedRapids != 1)
    return std::nullopt;
  return RapidSlip{"this rapid move of {0} has a feed, as no other of the program: the tool is not "
                   "fed, it goes through at full speed",
                   std::fabs(to.value() - from.value())};
}

} // namespace

std::optional<RapidSlip> rapidToChuck(const TurnedShapes &shapes, const PlacesOfPrograms &places,
                                      const Event &event, const RuleContext &ctx) {
  constexpr double deep = 0.5, onAxis = 1e-6; // mm
  const MachineState &before = ctx.before(), &after = ctx.after();
  if (!event.certain || event.inMachineCoordinates() || before.profile != ProfileMode::Off ||
      before.may(Fact::UnknownCode) || !after.frames.empty() || ctx.callDepth() > 0)
    return std::nullopt;
  if (auto fed = withFeed(places, event, ctx))
    return fed;
  const Interval &x = after.at(Axis::X), &z = after.at(Axis::Z);
  if (!(event.axes & zAxis) || !x.isConstant() || !z.isConstant() || after.machineAxes ||
      x.value() > onAxis)
    return std::nullopt;
  const Interval &from = before.at(Axis::Z);
  if (event.axes == zAxis && from.isConstant() && z.value() < from.value() - deep && hasFaced(ctx))
    return RapidSlip{"this rapid move leads {0} into the face that was just cut: a retract has the "
                     "other sign",
                     from.value() - z.value()};
  const auto unit = millimetresPer(ctx.dialect(), after);
  if (!unit || x.value() < -onAxis)
    return std::nullopt;
  const TurnedShape &shape = shapes.of(ctx);
  const auto face = shape.faceBefore(ctx.block().begin);
  if (!face || z.value() > *face * *unit - deep)
    return std::nullopt;
  return RapidSlip{"this rapid move ends on the axis {0} inside of the face, where nothing is "
                   "drilled yet",
                   *face * *unit - z.value()};
}

} // namespace ncvet
