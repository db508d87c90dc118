// A program end code is in a called program.
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {
namespace {

struct FlowProgramEndInSubprogramMemory {
  SourceRange first; ///< end of a subprogram without a caller
};

class FlowProgramEndInSubprogram final : public StatefulRule<FlowProgramEndInSubprogramMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FlowIssue);
    if (to.dialect().endReturns)
      to.onAction({Action::ProgramEnd, Action::ProgramEndRewind});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      // A file that says itself to be a subprogram is one without a caller too; its first end says
      // so for all of them.
      if (ctx.callDepth() == 0 &&
          ctx.index().programAt(ctx.block().begin).kind == ProgramKind::Subprogram &&
          (memory().first.empty() || memory().first.begin == event.word->offset))
        returns(memory().first = ctx.range(*event.word), event, ctx);
      return;
    }
    if (event.flowIssue() != FlowIssue::EndInSubprogram)
      return;
    if (ctx.dialect().endReturns)
      return returns(ctx.flowRange(), event, ctx);
    const std::string back = returnOf(ctx.dialect());
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding
          .message("`{0}` in a called program ends the whole job, not only this program",
                   ctx.text(ctx.flowRange()))
          .fix(FixSafety::Unsafe, "write `" + back + "`", ctx.replace(ctx.flowRange(), back));
  }

private:
  static void returns(SourceRange range, const Event &event, RuleContext &ctx) {
    const std::string back = returnOf(ctx.dialect());
    if (auto finding = ctx.report(range, event.certain))
      finding
          .message("`{0}` in a called program only returns here: {1} says so", ctx.text(range),
                   back)
          .fix(FixSafety::Unsafe, "write `" + back + "`", ctx.replace(range, back));
  }
};

} // namespace
NCVET_RULE(FlowProgramEndInSubprogram, flow_program_end_in_subprogram)
} // namespace ncvet
