// A block looks as if the machine coordinates of the block before were still in force.
#include "analyzer/facts/block_before.h"
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/project.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class CoordinateMachineMoveNotModal final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Motion});
    least_ = to.number("least", 100);
    next_ = to.dialect().facts->coordinates.machineMoveOfOneBlock;
    if (next_)
      to.onAction({Action::MachineMove});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (event.kind == EventKind::Code)
      return alone(event, ctx);
    if (next_)
      return afterMachineMove(event, ctx);
    if (event.inMachineCoordinates() || event.motion == MotionKind::Reference ||
        event.motion == MotionKind::Skip || !event.axes || !before.must(Fact::AtMachinePosition) ||
        (event.axes & before.machineAxes) || !before.machineAxes ||
        before.must(Fact::ReferenceReturned))
      return sleepInShape();
    // The retract axes of the machine: all of a lathe, the tool axis of a mill.
    const auto likely = ctx.dialect().isLathe()
                            ? uint16_t(1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z))
                            : uint16_t(1u << unsigned(toolAxis(ctx.dialect(), after)));
    if (event.axes & ~likely)
      return;
    for (unsigned axis = 0; axis < axisCount; ++axis)
      if ((event.axes >> axis & 1) && !(after.position[axis].hi <= -least_))
        return;
    if (auto finding = ctx.report(event))
      finding.message(
          "this value looks like a machine position, but the machine coordinates of the "
          "block before do not hold: it is driven in work coordinates");
  }

private:
  /// `SUPA` in a block that moves nothing, and a move without it in the next one.
  static void alone(const Event &event, RuleContext &ctx) {
    const AddressMask axes = ctx.dialect().axisWords | ctx.dialect().polarWords;
    if (ctx.block().hasAny(axes) || !ctx.block().items.empty())
      return;
    BlocksAhead ahead(ctx);
    Block next;
    if (!ahead.next(next) || !next.hasAny(axes) ||
        findCode(ctx.dialect(), next, {Action::MachineMove, Action::ReferenceReturn}))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Style)
          .message("`{0}` holds for its own block, which moves nothing: the next one is driven in "
                   "work coordinates",
                   ctx.code(event).name)
          .note(ahead.range(next), "this move");
  }

  /// The very next block goes on with another axis, as far as no work goes.
  void afterMachineMove(const Event &event, RuleContext &ctx) const {
    Block previous;
    BlocksBefore before(ctx);
    // A rotary axis that goes to its own place has none of the moved offset to fear.
    constexpr uint16_t rotary =
        uint16_t(1u << unsigned(Axis::A) | 1u << unsigned(Axis::B) | 1u << unsigned(Axis::C));
    if ((event.axes & rotary) || event.inMachineCoordinates() ||
        event.motion == MotionKind::Reference || !ctx.codes().empty() ||
        !ctx.before().must(Fact::AtMachinePosition) || !before.next(previous) ||
        !findCode(ctx.dialect(), previous, {Action::MachineMove}) ||
        (axesOf(ctx.dialect(), previous) & event.axes))
      return;
    for (unsigned axis = 0; axis < axisCount; ++axis)
      if ((event.axes >> axis & 1) && !(ctx.after().position[axis].lo >= least_) &&
          !(ctx.after().position[axis].hi <= -least_))
        return;
    if (auto finding = ctx.report(event))
      finding
          .message("machine coordinates held for the block before only: `{0}` is driven in work "
                   "coordinates",
                   ctx.text(ctx.blockRange()))
          .note(SourceRange{before.unit().source.id(), previous.begin, previous.end},
                "the block before");
  }

  double least_ = 100;
  bool next_ = false; ///< only the very next block is looked at
};

} // namespace
NCVET_RULE(CoordinateMachineMoveNotModal, coordinate_machine_move_not_modal)
} // namespace ncvet
