// Incremental dimensions are still on when the program ends.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CoordinateIncrementalLeftOn final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().group(StandardGroup::Distance) != noGroup && to.option("wanted", 0) != 0)
      to.on(EventKind::ProgramEnd);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &state = ctx.after();
    if (state.active(ctx.dialect(), StandardGroup::Distance) == groupUnset ||
        state.may(Fact::UnknownCode))
      return;
    const Truth on = state.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental});
    if (on == Truth::No)
      return;
    const CodeInfo *code = state.activeCode(ctx.dialect(), StandardGroup::Distance);
    if (auto finding = ctx.report(event, on == Truth::Yes))
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
