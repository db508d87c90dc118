// Incremental dimensions are still on when the program ends.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CoordinateIncrementalLeftOn final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().group(StandardGroup::Distance) != noGroup && to.option("wanted", 0) != 0)
      to.on({EventKind::ProgramEnd, EventKind::FlowIssue});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &state = ctx.after();
    // A subprogram's end ends a main program too.
    if (event.kind == EventKind::FlowIssue &&
        (FlowIssue(event.number) != FlowIssue::ReturnInMain ||
         ctx.index().programAt(ctx.block().begin).kind != ProgramKind::Main))
      return;
    // Where the end of a called program only returns, the caller goes on: another rule's matter.
    if (event.kind == EventKind::ProgramEnd && ctx.dialect().endReturns &&
        (ctx.callDepth() > 0 ||
         ctx.index().programAt(ctx.block().begin).kind == ProgramKind::Subprogram))
      return;
    if (state.active(ctx.dialect(), StandardGroup::Distance) == groupUnset)
      return;
    const Truth on = state.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental});
    // What the program has switched on itself is on, whatever codes nobody knows stand around it.
    if (on == Truth::No || (on != Truth::Yes && state.may(Fact::UnknownCode)))
      return;
    const CodeInfo *code = state.activeCode(ctx.dialect(), StandardGroup::Distance);
    const SourceRange where = event.kind == EventKind::FlowIssue ? ctx.flowRange()
                              : event.word                       ? ctx.range(*event.word)
                                                                 : ctx.blockRange();
    if (auto finding = ctx.report(where, on == Truth::Yes))
      finding
          .message("the program ends with `{0}` on: the next one drives its coordinates as "
                   "distances",
                   code ? code->name : "incremental dimensions")
          .note(state.originOf(ctx.dialect(), StandardGroup::Distance), "it is switched on here");
  }
};

} // namespace
NCVET_RULE(CoordinateIncrementalLeftOn, coordinate_incremental_left_on)
} // namespace ncvet
