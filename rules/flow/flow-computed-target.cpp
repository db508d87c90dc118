// A target that only the run decides.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class FlowComputedTarget final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.flag("wanted"))
      to.on(EventKind::FlowIssue);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.flowIssue() != FlowIssue::ComputedTarget)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message(
          "where `{0}` leads depends on a value that is not known here: nothing says that "
          "such a block or program exists",
          ctx.text(ctx.flowRange()));
  }
};

} // namespace
NCVET_RULE(FlowComputedTarget, flow_computed_target)
} // namespace ncvet
