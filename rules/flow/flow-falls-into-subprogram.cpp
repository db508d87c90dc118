// The main flow runs on into a local subprogram.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class FlowFallsIntoSubprogram final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.flowIssue() != FlowIssue::RunsIntoSubprogram)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message("the program runs on into this subprogram: there is no `M30` before it")
          .fix(FixSafety::Unsafe, "insert `M30` before the subprogram",
               {{ctx.flowRange().file, ctx.flowRange().begin, ctx.flowRange().begin}, "M30\n"});
  }
};

} // namespace
NCVET_RULE(FlowFallsIntoSubprogram, flow_falls_into_subprogram)
} // namespace ncvet
