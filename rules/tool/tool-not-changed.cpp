// A tool is named, and the program cuts or ends without having changed it in.
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/unnamed_tool_change.h"
#include "analyzer/program/wanted_blocks.h"

namespace ncvet {
namespace {

struct ToolNotChangedMemory {
  NamelessChanges nameless;
  SourceRange named;
  SourceRange first;            ///< the first tool that the program names
  bool isChangedByCode = false; ///< a tool was changed
  int64_t number = 0;
  bool ahead = false; ///< it was named after a change, before the first move: for a later one
};

class ToolNotChanged final : public StatefulRule<ToolNotChangedMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().toolChangeByT || !to.flag("wanted"))
      return;
    mayChangeByT_ = to.flag("mayChangeByT");
    to.on({EventKind::ToolWord, EventKind::ToolChange, EventKind::ProgramEnd});
    to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (ctx.callDepth() > 0) { // a program of its own may change the tool
      if (event.kind == EventKind::ToolChange) {
        memory().named = {};
        memory().nameless.see(event, ctx);
      }
      return;
    }
    if (event.kind == EventKind::ToolWord && event.word) {
      forgotten(event, ctx);
      memory().named = ctx.range(*event.word);
      if (!memory().first.end)
        memory().first = memory().named;
      memory().number = numberOf(event);
      memory().ahead = mayChangeByT_ && ctx.before().must(Fact::ToolCalled) &&
                       !ctx.before().may(Fact::MovedSinceTool) && memory().isChangedByCode;
      const Interval number = event.toolNumber();
      if (mayChangeByT_ && number.isConstant() && number.value() == 0)
        memory().named = {}; // the place is emptied
    } else if (event.kind == EventKind::ToolChange) {
      memory().named = {};
      memory().isChangedByCode = true;
      memory().nameless.see(event, ctx);
    } else if (event.kind == EventKind::Motion) {
      atCut(event, ctx);
    } else if (event.kind == EventKind::ProgramEnd && memory().named.end && !memory().ahead &&
               !ctx.after().may(Fact::UnknownCode) && (!mayChangeByT_ || changesTools(ctx)) &&
               !waitsForNextPart(ctx)) {
      if (auto finding = ctx.report(memory().named))
        finding.message("`{0}` names a tool that nothing changes in: the program cuts with the one "
                        "before",
                        ctx.text(memory().named));
    }
  }

private:
  /// The first tool of the program is got ready for the next part.
  bool waitsForNextPart(const RuleContext &ctx) const {
    return memory().first.begin != memory().named.begin &&
           ctx.text(memory().first) == ctx.text(memory().named);
  }

  /// A program that never changes a tool by a code may be for a machine where T does it.
  static bool changesTools(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block :
         blocksNaming(ctx.index(), program, ctx.dialect(), {Action::ToolChange}))
      if (findCode(ctx.dialect(), block, {Action::ToolChange}))
        return true;
    return false;
  }

  /// A tool that is got ready while another one cuts is usual; the program has changed in none yet.
  void atCut(const Event &event, RuleContext &ctx) const {
    if (!memory().named.end || event.code == noCode || event.motion == MotionKind::Rapid ||
        event.motion == MotionKind::Reference || ctx.after().preselected == notSet ||
        !memory().nameless.inForce(ctx.after()) || ctx.after().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("`{0}` cuts while `{1}` still waits for its change: whatever is in the spindle "
                   "cuts",
                   ctx.code(event).name, ctx.text(memory().named))
          .note(memory().named, "the tool is named here");
    memory().named = {};
  }

  static int64_t numberOf(const Event &event) {
    return event.toolNumber().isConstant() ? int64_t(event.toolNumber().value()) : 0;
  }

  /// Another tool is named before this one was changed in.
  void forgotten(const Event &event, RuleContext &ctx) const {
    const int64_t next = numberOf(event);
    if (!memory().named.end || memory().number <= 0 || next <= 0 || next == memory().number ||
        ctx.before().preselected != memory().number || ctx.before().may(Fact::UnknownCode) ||
        (mayChangeByT_ && !changesTools(ctx)))
      return;
    if (auto finding = ctx.report(memory().named))
      finding
          .message("`{0}` names a tool that nothing changes in: `{1}` takes its place",
                   ctx.text(memory().named), ctx.text(*event.word))
          .note(ctx.range(*event.word), "the next tool is named here");
  }

  bool mayChangeByT_ = false; ///< on some machines of the control T changes the tool by itself
};

} // namespace
NCVET_RULE(ToolNotChanged, tool_not_changed)
} // namespace ncvet
