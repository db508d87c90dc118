// A called program leaves a mode changed that the caller relies on.
#include "analyzer/reliance.h"
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowSubprogramLeavesState final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CallReturned);
    atCause_ = to.option("atCause", 0) != 0;
    atCall_ = to.option("atCall", 0) != 0;
    watched_ = groupMask(to.dialect(),
                         {StandardGroup::Distance, StandardGroup::Plane, StandardGroup::Units,
                          StandardGroup::WorkOffset, StandardGroup::FeedMode, StandardGroup::Polar,
                          StandardGroup::Rotation, StandardGroup::Scaling});
    // A program that begins with a reset has stated the dimensions.
    if (atCause_ || atCall_)
      initial_ = groupMask(to.dialect(), {StandardGroup::Distance});
  }

  void on(const Event &, RuleContext &ctx) override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (after.may(Fact::UnknownCode) && !before.may(Fact::UnknownCode))
      return;
    ModeChanges changes;
    // A mode that the caller had not stated yet may well be set up by the call.
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i)
      if ((watched_ >> i & 1) && ((before.statedMust >> i & 1) || (initial_ >> i & 1)) &&
          !(before.group[i] & (after.group[i] | groupUnset)))
        changes.groups |= uint64_t(1) << i;
    if (!changes.any())
      return;
    if (atCall_)
      return atCall(changes, ctx);
    if (atCause_)
      return atCause(changes, ctx);
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
  /// Reported at the call that brings the change, whether or not the caller notices.
  static void atCall(const ModeChanges &changes, RuleContext &ctx) {
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i) {
      if (!(changes.groups >> i & 1))
        continue;
      if (auto finding = ctx.report(ctx.blockRange()))
        finding
            .message("the called program comes back with another state of {0}: the caller goes on "
                     "with it",
                     ctx.dialect().groups[i].title)
            .note(ctx.after().origin.group[i], "it is set here and not set back");
      return;
    }
  }

  bool atCall_ = false;
  /// Reported where the called program changes the mode, whether or not the caller notices.
  static void atCause(const ModeChanges &changes, RuleContext &ctx) {
    for (unsigned i = 0; i < ctx.dialect().groups.size(); ++i) {
      const Origin &origin = ctx.after().origin.group[i];
      if (!(changes.groups >> i & 1) || !origin.known())
        continue;
      if (auto finding = ctx.report(origin.range()))
        finding
            .message("the {0} is set here and not set back: the caller goes on with it",
                     ctx.dialect().groups[i].title)
            .note(ctx.blockRange(), "called here");
    }
  }

  bool atCause_ = false;
  uint64_t watched_ = 0, initial_ = 0;
};

} // namespace
NCVET_RULE(FlowSubprogramLeavesState, flow_subprogram_leaves_state)
} // namespace ncvet
