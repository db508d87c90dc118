// Work with a tool whose offset is cancelled.
#include "analyzer/once.h"

namespace ncvet {
namespace {

class ToolOffsetCancelled final : public Rule {
public:
  void listen(Subscriptions &to) override {
    edges_ = to.option("edges", 0) != 0;
    length_ = to.option("length", 0) != 0;
    if (to.dialect().isLathe() || edges_ || length_)
      to.onChange({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &state = ctx.after();
    if (edges_) {
      withoutEdge(event, ctx);
      return;
    }
    if (length_) {
      withoutLength(event, ctx);
      return;
    }
    // A machine position needs no offset, nor does the reference point.
    if (state.toolOffset != 0 || state.tool <= 0 || event.number == 1 ||
        event.motion == MotionKind::Reference || event.code == noCode ||
        ctx.before().toolOffset != 0)
      return;
    // Having cut, the tool may go home without it.
    const bool rapid = event.kind == EventKind::Motion && event.motion == MotionKind::Rapid;
    if (rapid && ctx.before().may(Fact::CutSinceTool))
      return;
    if (!once_.speaks(state.origin.tool, ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("tool {0} moves without an offset: its length, nose radius and tip are missing",
                   state.tool)
          .note(state.origin.tool, "the tool is called here");
  }

private:
  /// D is length and radius: with D0 the tool has none.
  void withoutEdge(const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.before();
    const bool cuts = event.kind == EventKind::CycleRun ||
                      (event.motion != MotionKind::Rapid && event.motion != MotionKind::Reference);
    if (!cuts || event.number == 1 || ctx.after().radiusOffset != 0 ||
        state.may(Fact::UnknownCode) || !state.must(Fact::ToolCalled) ||
        !once_.speaks(ctx.after().origin.radiusOffset, ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain)) {
      finding.message("the tool cuts with D0: neither its length nor its radius is in force")
          .note(ctx.after().origin.radiusOffset, "D0 is programmed here");
      if (event.kind == EventKind::Motion)
        finding.severity(Severity::Warning);
    }
  }

  /// D0 suspends the tool's length until G43, G44 or the next change.
  void withoutLength(const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Origin &off = state.origin.lengthOffset;
    if (event.kind != EventKind::Motion || ctx.before().lengthOffset != 0 ||
        state.lengthOffset != 0 || event.number == 1 || state.may(Fact::UnknownCode) ||
        !state.must(Fact::ToolCalled) ||
        !(event.axes >> unsigned(toolAxis(ctx.dialect(), state)) & 1))
      return;
    const CodeIndex on = ctx.dialect().find("G43");
    if (on != noCode && ctx.dialect().codes[on].group != noGroup) {
      const Origin &restored = state.origin.group[ctx.dialect().codes[on].group];
      if (restored.known() && (restored.file != off.file || restored.begin > off.begin))
        return;
    }
    if (!once_.speaks(off, ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("the tool moves along its axis with its length suspended: every depth is wrong "
                   "by the length")
          .severity(Severity::Warning)
          .note(off, "`D0` suspends it here");
  }

  bool edges_ = false;
  bool length_ = false;
  OncePerCause once_;
};

} // namespace
NCVET_RULE(ToolOffsetCancelled, tool_offset_cancelled)
} // namespace ncvet
