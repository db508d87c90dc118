// A loop has no way out.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowEndlessLoop final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) override {
    if (FlowIssue(event.number) != FlowIssue::EndlessLoop)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message("this loop never ends: nothing in it changes what decides about leaving it");
  }
};

} // namespace
NCVET_RULE(FlowEndlessLoop, flow_endless_loop)
} // namespace ncvet
