// A called program leaves a mode changed that the caller relies on.
#include "analyzer/reliance.h"
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowSubprogramLeavesState final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CallReturned);
    watched_ = groupMask(to.dialect(),
                         {StandardGroup::Distance, StandardGroup::Plane, StandardGroup::Units,
                          StandardGroup::WorkOffset, StandardGroup::FeedMode, StandardGroup::Polar,
                          StandardGroup::Rotation, StandardGroup::Scaling});
  }

  void on(const Event &, RuleContext &ctx) override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (after.may(Fact::UnknownCode) && !before.may(Fact::UnknownCode))
      return;
    ModeChanges changes;
    // A mode that the caller had not stated yet may well be set up by the call.
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i)
      if ((watched_ >> i & 1) && (before.statedMust >> i & 1) &&
          !(before.group[i] & after.group[i]))
        changes.groups |= uint64_t(1) << i;
    if (!changes.any())
      return;
    SourceRange user;
    const ModeChanges relied = firstReliance(ctx, changes, user);
    if (!relied.any())
      return;
    unsigned group = 0;
    while (!(relied.groups >> group & 1))
      ++group;
    if (auto finding = ctx.report(user))
      finding
          .message("the {0} here is the one that the called program left behind",
                   ctx.dialect().groups[group].title)
          .note(after.origin.group[group], "set here and not set back")
          .note(ctx.blockRange(), "called here");
  }

private:
  uint64_t watched_ = 0;
};

} // namespace
NCVET_RULE(FlowSubprogramLeavesState, flow_subprogram_leaves_state)
} // namespace ncvet
