// Every pass of a repeated call does the same again.
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class FlowRepeatWithoutChange final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.flowIssue() != FlowIssue::RepeatSame || !ctx.after().must(Fact::Cut))
      return;
    // Where a counter of the section does not change, another rule says so.
    for (const RepeatedSection &section : repeatedSections(ctx.index()))
      if (section.at == ctx.block().begin && countedFrame(ctx.index(), ctx.dialect(), section).code)
        return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message(ctx.outcome().flow.kind == FlowKind::Repeat
                          ? "`{0}` cuts the same path again: nothing in the section moves on"
                          : "`{0}` is called several times, and every pass cuts the same path: "
                            "nothing in it moves on",
                      ctx.text(ctx.flowRange()));
  }
};

} // namespace
NCVET_RULE(FlowRepeatWithoutChange, flow_repeat_without_change)
} // namespace ncvet
