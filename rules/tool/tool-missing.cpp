// A cut before any tool was called.
#include "analyzer/facts/silent_program.h"
#include "analyzer/facts/unnamed_tool_change.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct ToolMissingMemory {
  Origin empty; ///< the change that has put the last tool away
  NamelessChanges nameless;
};

class ToolMissing final : public StatefulRule<ToolMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Motion, EventKind::CycleRun, EventKind::ToolChange});
    anyMachine_ = to.flag("anyMachine");
    whereNamed_ = to.flag("whereNamed");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::ToolChange) {
      memory().empty = isEmptied(ctx) ? ctx.after().origin.of(StatePart::Tool) : Origin();
      return memory().nameless.see(event, ctx);
    }
    if (memory().empty.known())
      return withoutTool(event, ctx);
    // A change that names no tool brings in none of the program's.
    if (ctx.before().must(Fact::Cut))
      return sleepInShape();
    const bool nameless = memory().nameless.inForce(ctx.after());
    // Only the first cut: it is the same mistake in all that follow.
    if (event.code == noCode || (ctx.after().must(Fact::ToolCalled) && !nameless) ||
        ctx.before().must(Fact::Cut) || ctx.after().preselected != notSet ||
        ctx.after().may(Fact::UnknownCode))
      return;
    if (event.kind == EventKind::CycleRun && !event.axes && ctx.code(event).group != noGroup)
      return;
    if (event.kind == EventKind::Motion &&
        (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
         event.motion == MotionKind::Skip || event.inMachineCoordinates()))
      return;
    // Other axes than those of the work are driven by grinding and loading machines.
    constexpr uint16_t ofWork =
        1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y) | 1u << unsigned(Axis::Z);
    if (event.kind == EventKind::Motion && !(event.axes & ofWork))
      return;
    const bool unsaid =
        !ctx.after().may(Fact::SpeedSet) && !ctx.after().may(Fact::SpindleStated) && !nameless;
    if (anyMachine_ && unsaid && saysNothingOfTools(ctx))
      return;
    if (whereNamed_ && !nameless && callsNoTool(ctx))
      return;
    const bool certain = event.certain && (nameless || !ctx.after().may(Fact::ToolCalled));
    if (auto finding = ctx.report(ctx.blockRange(), certain))
      finding.message("`{0}` cuts before any tool is called: whatever is in the machine cuts, with "
                      "its old data",
                      ctx.code(event).name);
  }

private:
  /// `T0 M06` on a mill.
  static bool isEmptied(const RuleContext &ctx) {
    return ctx.after().tool == 0 && ctx.before().tool > 0 && !ctx.dialect().isLathe() &&
           !ctx.dialect().toolChangeByT && !ctx.dialect().facts->tools.cuttingEdges;
  }

  /// A cut with an empty spindle.
  void withoutTool(const Event &event, RuleContext &ctx) const {
    const bool cuts =
        event.code != noCode &&
        (event.kind == EventKind::Motion ? isFeed(event.motion) && !event.inMachineCoordinates()
                                         : event.axes && makesHole(ctx.code(event).cycle));
    if (!cuts || ctx.after().tool != 0 || ctx.after().may(Fact::UnknownCode))
      return;
    const bool turns = ctx.after().spindle == spindleCw || ctx.after().spindle == spindleCcw;
    const Origin change = std::exchange(memory().empty, Origin());
    if (!turns)
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}` cuts with an empty spindle: T0 has put the tool away",
                   ctx.code(event).name)
          .note(change, "T0 is changed in here");
  }

  /// Whether the program and its callers have one tool, which is in the machine.
  static bool callsNoTool(const RuleContext &ctx) {
    return noRunningProgramHas(ctx, [&](const Block &block) {
      return block.has(letterAddress('T')) || findCode(ctx.dialect(), block, {Action::ToolChange});
    });
  }

  bool whereNamed_ = false; ///< only a program that calls a tool somewhere is judged
  bool anyMachine_ = false; ///< a program that names no tool at all may be for a machine without
};

} // namespace
NCVET_RULE(ToolMissing, tool_missing)
} // namespace ncvet
