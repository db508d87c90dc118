// What runs behind a skippable block depends on the skip switch.
#include "analyzer/reliance.h"
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowBlockSkipChangesState final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Block});
    atCause_ = to.option("atCause", 0) != 0;
    watched_ = groupMask(to.dialect(),
                         {StandardGroup::Motion, StandardGroup::Distance, StandardGroup::Plane,
                          StandardGroup::Units, StandardGroup::Compensation,
                          StandardGroup::LengthOffset, StandardGroup::WorkOffset,
                          StandardGroup::FeedMode, StandardGroup::SpeedMode, StandardGroup::Cycle});
    if (atCause_) // the next motion code stands in most blocks
      watched_ &= ~groupMask(to.dialect(), {StandardGroup::Motion});
  }

  void on(const Event &, RuleContext &ctx) override {
    if (ctx.block().skip < 0)
      return;
    const MachineState &before = ctx.before(), &after = ctx.after();
    ModeChanges changes;
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i)
      if ((watched_ >> i & 1) && before.group(i) != after.group(i))
        changes.groups |= uint64_t(1) << i;
    changes.tool = before.tool != after.tool && before.tool != notSet;
    if (!changes.any())
      return;
    if (atCause_) {
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.message("this change of {0} stands in a block that can be skipped: a key at the "
                        "panel decides what holds behind it",
                        titleOf(changes, ctx.dialect()));
      return;
    }
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
  bool atCause_ = false; ///< whether or not a later block relies on it
};

} // namespace
NCVET_RULE(FlowBlockSkipChangesState, flow_block_skip_changes_state)
} // namespace ncvet
