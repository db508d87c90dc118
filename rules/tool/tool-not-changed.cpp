// A tool is named, and the program cuts or ends without having changed it in.
#include "analyzer/facts/unnamed_tool_change.h"

namespace ncvet {
namespace {

class ToolNotChanged final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().toolChangeByT || to.option("wanted", 0) == 0)
      return;
    to.on({EventKind::ToolWord, EventKind::ToolChange, EventKind::ProgramEnd});
    to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (ctx.callDepth() > 0) { // a program of its own may change the tool
      if (event.kind == EventKind::ToolChange) {
        named_ = {};
        nameless_.see(event, ctx);
      }
      return;
    }
    if (event.kind == EventKind::ToolWord && event.word) {
      forgotten(event, ctx);
      named_ = ctx.range(*event.word);
      number_ = numberOf(event);
    } else if (event.kind == EventKind::ToolChange) {
      named_ = {};
      nameless_.see(event, ctx);
    } else if (event.kind == EventKind::Motion) {
      atCut(event, ctx);
    } else if (event.kind == EventKind::ProgramEnd && named_.end &&
               !ctx.after().may(Fact::UnknownCode)) {
      if (auto finding = ctx.report(named_))
        finding.message("`{0}` names a tool that nothing changes in: the program cuts with the one "
                        "before",
                        ctx.text(named_));
    }
  }
  void remember(RuleMemory &memory) const override { memory(nameless_, named_, number_); }

private:
  /// A tool that is got ready while another one cuts is usual; the program has changed in none yet.
  void atCut(const Event &event, RuleContext &ctx) {
    if (!named_.end || event.code == noCode || event.motion == MotionKind::Rapid ||
        event.motion == MotionKind::Reference || ctx.after().preselected == notSet ||
        !nameless_.inForce(ctx.after()) || ctx.after().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("`{0}` cuts while `{1}` still waits for its change: whatever is in the spindle "
                   "cuts",
                   ctx.code(event).name, ctx.text(named_))
          .note(named_, "the tool is named here");
    named_ = {};
  }

  static int64_t numberOf(const Event &event) {
    return event.value.isConstant() ? int64_t(event.value.value()) : 0;
  }

  /// Another tool is named before this one was changed in.
  void forgotten(const Event &event, RuleContext &ctx) {
    const int64_t next = numberOf(event);
    if (!named_.end || number_ <= 0 || next <= 0 || next == number_ ||
        ctx.before().preselected != number_ || ctx.before().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(named_))
      finding
          .message("`{0}` names a tool that nothing changes in: `{1}` takes its place",
                   ctx.text(named_), ctx.text(*event.word))
          .note(ctx.range(*event.word), "the next tool is named here");
  }

  NamelessChanges nameless_;
  int64_t number_ = 0;
  SourceRange named_;
};

} // namespace
NCVET_RULE(ToolNotChanged, tool_not_changed)
} // namespace ncvet
