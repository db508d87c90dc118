// A program calls itself, directly or through others.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class FlowRecursion final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.flowIssue() != FlowIssue::Recursion)
      return;
    auto finding = ctx.report(ctx.flowRange(), event.certain);
    if (!finding)
      return;
    finding.message("`{0}` calls a program that is still being executed: the calls never end",
                    ctx.text(ctx.flowRange()));
    if (ctx.flowRelated().end)
      finding.note(ctx.flowRelated(), "this is the program that is called again");
  }
};

} // namespace
NCVET_RULE(FlowRecursion, flow_recursion)
} // namespace ncvet
