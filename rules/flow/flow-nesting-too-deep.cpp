// Calls inside calls go deeper than the control can follow.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowNestingTooDeep final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) override {
    if (FlowIssue(event.number) != FlowIssue::TooDeep)
      return;
    auto finding = ctx.report(ctx.flowRange(), event.certain);
    if (!finding)
      return;
    finding.message("`{0}` is call level {1}, the control follows {2}: it stops here",
                    ctx.text(ctx.flowRange()), ctx.callDepth() + 1, ctx.dialect().limits.callDepth);
  }
};

} // namespace
NCVET_RULE(FlowNestingTooDeep, flow_nesting_too_deep)
} // namespace ncvet
