// A code that is not known to cancel a drilling cycle stands while the cycle is active.
#include "analyzer/lookahead.h"

namespace ncvet {
namespace {

class CycleStateChangedInside final : public Rule {
public:
  void listen(Subscriptions &to) override {
    const GroupIndex cycles = to.dialect().group(StandardGroup::Cycle);
    if (cycles == noGroup)
      return;
    to.onCode([&](const CodeInfo &code) {
      return !code.cancelsCycle && code.group != cycles &&
             (isMotion(code.action) || code.action == Action::Cycle);
    });
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &before = ctx.before();
    const CodeInfo *cycle = before.activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (!cycle || cycle->action != Action::Cycle || !makesHole(cycle->cycle) ||
        ctx.find({Action::CycleCancel}))
      return;
    const CodeInfo &code = ctx.code(event);
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` stands while `{1}` of line {2} is active: it is not documented that it "
                   "cancels the cycle",
                   code.name, cycle->name, lineOf(ctx, before.origin.cycle))
          .note(before.origin.cycle, cycle->name + " becomes active here")
          .fix(FixSafety::Unsafe,
               "insert " + cancelOf(ctx.dialect(), *cycle) + " before this block",
               ctx.insertBlockBefore(cancelOf(ctx.dialect(), *cycle)));
  }
};

} // namespace
NCVET_RULE(CycleStateChangedInside, cycle_state_changed_inside)
} // namespace ncvet
