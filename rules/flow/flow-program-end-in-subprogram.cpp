// A program end code is in a called program.
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"

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
    if (to.flag("interrupts"))
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return startedByInput(ctx.block().items[event.item()], ctx);
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
    const std::string back = returnHere(ctx);
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding
          .message("`{0}` in a called program ends the whole job, not only this program",
                   ctx.text(ctx.flowRange()))
          .fix(FixSafety::Unsafe, "write `" + back + "`", ctx.replace(ctx.flowRange(), back));
  }

private:
  /// `SETINT(3) PRIO=1 UP`: a program that an input starts, which the reader gives as a name alone.
  static void startedByInput(const Item &item, RuleContext &ctx) {
    Project *const project = ctx.unit().project;
    const llvm::StringRef name = ctx.text(ctx.range(item));
    if (item.kind != ItemKind::Output || !project || item.arguments || name.empty() ||
        !llvm::all_of(name, [](char c) { return llvm::isAlnum(c) || c == '_'; }))
      return;
    const auto [unit, program] = project->findProgram(ctx.unit(), name);
    if (!program)
      return;
    for (const Block &block : blocks(unit->index, program->body, program->end)) {
      const CodeInfo *const code =
          findCode(ctx.dialect(), block, {Action::ProgramEnd, Action::ProgramEndRewind});
      if (!code)
        continue;
      const SourceRange range = wordsRange(unit->source.id(), block);
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("`{0}` ends a program that an input starts: it ends with `RET`, which takes "
                     "the interrupted program up again",
                     code->name)
            .note(ctx.range(item), "it is started here");
      return;
    }
  }

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
