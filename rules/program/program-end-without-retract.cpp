// The program ends with the tool in the work.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

struct ProgramEndWithoutRetractMemory {
  SourceRange job; ///< what has left the tool somewhere, until its axis moves
};

class ProgramEndWithoutRetract final : public StatefulRule<ProgramEndWithoutRetractMemory> {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().isLathe() && to.flag("wanted"))
      to.on({EventKind::ProgramEnd, EventKind::Motion});
    if (!to.dialect().isLathe() && to.flag("wanted"))
      to.onCode([](const CodeInfo &code) {
        return code.action == Action::ProfileRun || code.cycle == CycleKind::Surface;
      });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    const Axis tool = toolAxis(ctx.dialect(), state);
    if (event.kind == EventKind::Code) {
      memory().job = ctx.range(*event.word);
      return;
    }
    if (event.kind == EventKind::Motion) {
      if (event.axes >> unsigned(tool) & 1)
        memory().job = {};
      return;
    }
    if (memory().job.end && ctx.callDepth() == 0 && !state.may(Fact::UnknownCode)) {
      if (auto finding = ctx.report(event))
        finding.message("the program ends after `{0}` without a move of the tool axis: it does not "
                        "say where the tool is",
                        ctx.text(memory().job));
      return;
    }
    // Fed down since, and not above that level again.
    if (ctx.callDepth() > 0 || !state.must(Fact::Cut) || state.may(Fact::UnknownCode) ||
        !state.fedFrom.get().isConstant() || !state.at(tool).isConstant() ||
        state.at(tool).value() >= state.fedFrom.get().value())
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "the program ends with the tool at depth: the next one begins inside the work");
  }
};

} // namespace
NCVET_RULE(ProgramEndWithoutRetract, program_end_without_retract)
} // namespace ncvet
