// A jump or a return names a block that does not exist.
#include "analyzer/facts/silent_program.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class FlowUndefinedTarget final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.flowIssue() != FlowIssue::UnknownBlock)
      return;
    if (ctx.outcome().flow.kind == FlowKind::CallLocal &&
        !ctx.dialect().facts->program.callsBlocks) // other controls know it as a subprogram
      return;
    // The block is one of the caller's, and who calls the program is not known here.
    if (ctx.outcome().flow.kind == FlowKind::Return && ctx.callDepth() == 0 && onlyReturns(ctx))
      return;
    // What decides may be another value the next time: a parameter at the head of the program.
    if (ctx.outcome().flow.condition == Truth::No) {
      if (auto finding = ctx.report(ctx.flowRange(), event.certain))
        finding.severity(Severity::Warning)
            .message("`{0}` leads to a block that is not there: where its condition holds the "
                     "control stops with an alarm",
                     ctx.text(ctx.flowRange()));
      return;
    }
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message("`{0}` leads to a block that is not there: the control stops with an alarm",
                      ctx.text(ctx.flowRange()));
  }
};

} // namespace
NCVET_RULE(FlowUndefinedTarget, flow_undefined_target)
} // namespace ncvet
