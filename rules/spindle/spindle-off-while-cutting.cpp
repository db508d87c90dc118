// A feed move or a cutting cycle while the spindle stands.
#include "analyzer/once.h"
#include "interp/tool_data.h"

namespace ncvet {
namespace {

class SpindleOffWhileCutting final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Motion, EventKind::CycleRun}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode || ctx.before().profile == 1)
      return;
    constexpr uint16_t linear =
        uint16_t(~(1u << unsigned(Axis::A) | 1u << unsigned(Axis::B) | 1u << unsigned(Axis::C)));
    const CodeInfo &code = ctx.code(event);
    if (event.kind == EventKind::Motion) {
      if (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
          event.motion == MotionKind::Skip || event.number == 1 || !(event.axes & linear) ||
          code.spindle == SpindleNeed::StartsItself)
        return; // a rotary axis alone positions, or the work turns against a wheel
      // `G1 X` without a number moves nothing.
      if (llvm::none_of(ctx.block().words,
                        [&](const Word &word) {
                          return (ctx.dialect().axisWords & maskOf(word.address)) &&
                                 !word.has(wordNoValue);
                        }) &&
          ctx.block().hasAny(ctx.dialect().axisWords))
        return;
      // No motion was asked for, and none is made for want of a feed: other rules say so.
      if (const GroupIndex motion = ctx.dialect().group(StandardGroup::Motion);
          motion != noGroup && !(ctx.after().mayBeStated(motion)) &&
          !ctx.after().may(Fact::FeedSet))
        return;
    } else if (code.spindle == SpindleNeed::Any || code.spindle == SpindleNeed::StartsItself ||
               (!event.axes && code.group != noGroup && !code.firesOnEveryBlock)) {
      return; // without axis words a modal cycle sets modes only
    }
    // Behind rigid tapping another rule speaks.
    if (ctx.before().may(Fact::SpindleStoppedByTap))
      return;
    // M05 stops behind the block's move, M03 starts before it; a hole in a block that moves nowhere
    // is made behind everything.
    const bool behind = event.kind == EventKind::CycleRun && code.firesOnEveryBlock && !event.axes;
    const MachineState &state =
        ctx.find({Action::SpindleStop}) && !behind ? ctx.before() : ctx.after();
    constexpr uint8_t turning = spindleCw | spindleCcw;
    const uint8_t live =
        ctx.find({Action::LiveToolStop}) ? ctx.before().liveTool : ctx.after().liveTool;
    if (!(state.spindle & (spindleOff | spindleOriented)) ||
        !(live & (spindleOff | spindleOriented)))
      return;
    // After a code of the machine's builder it may be doing anything.
    if (state.spindle == spindleAny || live == spindleAny)
      return;
    const bool may = (state.spindle & turning) || (live & turning);
    if (may && ctx.after().may(Fact::UnknownCode))
      return;
    if (const ToolData *tool = toolInUse(ctx.machine(), state); tool && tool->kind == "probe")
      return;
    const Origin &origin = state.origin.of(StatePart::Spindle);
    if (!once_.speaks(origin, ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain && !may)) {
      // Neither tool, speed nor spindle: the program may run axes in, or guide a laser.
      if (!state.may(Fact::ToolCalled) && !state.may(Fact::SpeedSet) &&
          !state.may(Fact::SpindleStated))
        finding.severity(Severity::Warning);
      const bool perRevolution = state.isActive(ctx.dialect(), StandardGroup::FeedMode,
                                                {Action::FeedPerRevolution}) == Truth::Yes;
      finding
          .message("`{0}` cuts while the spindle {1}{2}", code.name,
                   state.may(Fact::SpindleStated) ? "stands" : "was never started",
                   perRevolution ? ": with feed per revolution the machine waits for ever"
                                 : ": the tool breaks at the first contact")
          .note(origin, "the spindle is stopped here");
    }
  }
  void remember(RuleMemory &memory) const override { memory(once_); }

private:
  OncePerCause once_;
};

} // namespace
NCVET_RULE(SpindleOffWhileCutting, spindle_off_while_cutting)
} // namespace ncvet
