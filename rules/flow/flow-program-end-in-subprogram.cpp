// A program end code stands in a called program.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowProgramEndInSubprogram final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) override {
    if (FlowIssue(event.number) != FlowIssue::EndInSubprogram)
      return;
    if (ctx.dialect().endReturns) {
      if (auto finding = ctx.report(ctx.flowRange(), event.certain))
        finding.message("`{0}` in a called program only returns here: M17 says so",
                        ctx.text(ctx.flowRange()));
      return;
    }
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding
          .message("`{0}` in a called program ends the whole job, not only this program",
                   ctx.text(ctx.flowRange()))
          .fix(FixSafety::Unsafe, "write `M99`", ctx.replace(ctx.flowRange(), "M99"));
  }
};

} // namespace
NCVET_RULE(FlowProgramEndInSubprogram, flow_program_end_in_subprogram)
} // namespace ncvet
