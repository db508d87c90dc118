// WHILE, DO and END do not belong together.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowStructureMismatch final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) override {
    if (FlowIssue(event.number) == FlowIssue::RepeatOverlap) {
      if (auto finding = ctx.report(ctx.flowRange(), event.certain))
        finding
            .message("`{0}` repeats a part of a bracket of structured flow",
                     ctx.text(ctx.flowRange()))
            .note(ctx.flowRelated(), "the bracket begins here");
      return;
    }
    if (FlowIssue(event.number) == FlowIssue::IntoStructure) {
      if (auto finding = ctx.report(ctx.flowRange(), event.certain))
        finding
            .message("`{0}` leads into a bracket of structured flow from outside: its head never "
                     "ran",
                     ctx.text(ctx.flowRange()))
            .note(ctx.flowRelated(), "it leads here");
      return;
    }
    if (FlowIssue(event.number) != FlowIssue::StructureMismatch ||
        (ctx.outcome().flow.kind != FlowKind::Structure && ctx.outcome().flow.loop == 0))
      return; // an END without a number is no statement of this control
    auto finding = ctx.report(ctx.flowRange(), event.certain);
    if (!finding)
      return;
    finding.message("`{0}` has no partner: the control stops with an alarm",
                    ctx.text(ctx.flowRange()));
  }
};

} // namespace
NCVET_RULE(FlowStructureMismatch, flow_structure_mismatch)
} // namespace ncvet
