// What runs behind a skippable block depends on the skip switch.
#include "analyzer/reliance.h"
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowBlockSkipChangesState final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Block});
    watched_ = groupMask(to.dialect(),
                         {StandardGroup::Motion, StandardGroup::Distance, StandardGroup::Plane,
                          StandardGroup::Units, StandardGroup::Compensation,
                          StandardGroup::LengthOffset, StandardGroup::WorkOffset,
                          StandardGroup::FeedMode, StandardGroup::SpeedMode, StandardGroup::Cycle});
  }

  void on(const Event &, RuleContext &ctx) override {
    if (ctx.block().skip < 0)
      return;
    const MachineState &before = ctx.before(), &after = ctx.after();
    ModeChanges changes;
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i)
      if ((watched_ >> i & 1) && before.group[i] != after.group[i])
        changes.groups |= uint64_t(1) << i;
    changes.tool = before.tool != after.tool && before.tool != notSet;
    if (!changes.any())
      return;
    SourceRange user;
    const ModeChanges relied = firstReliance(ctx, changes, user);
    if (!relied.any())
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("with the skip switch on, the program goes on without this change of {0}",
                   titleOf(relied, ctx.dialect()))
          .note(user, "this block depends on the switch");
  }

private:
  uint64_t watched_ = 0;
};

} // namespace
NCVET_RULE(FlowBlockSkipChangesState, flow_block_skip_changes_state)
} // namespace ncvet
