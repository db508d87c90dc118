// A called program does not come to its return.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowReturnMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FlowIssue);
    endCounts_ = to.option("programEndCounts", 0) != 0;
  }

  void on(const Event &event, RuleContext &ctx) override {
    const auto issue = FlowIssue(event.number);
    const bool endCode = issue == FlowIssue::EndInSubprogram && endCounts_;
    if (issue != FlowIssue::SubprogramRunsOut && !endCode)
      return;
    auto finding = ctx.report(ctx.flowRange(), event.certain);
    if (!finding)
      return;
    if (endCode)
      finding.message("`{0}` ends the job inside a called program: the way back is `M99`",
                      ctx.text(ctx.flowRange()));
    else
      finding.message("the called program ends without `M99`: the control does not find back")
          .fix(FixSafety::Unsafe, "insert `M99` behind this block",
               TextEdit{{ctx.flowRange().file, ctx.flowRange().end, ctx.flowRange().end}, "\nM99"});
  }

private:
  bool endCounts_ = false;
};

} // namespace
NCVET_RULE(FlowReturnMissing, flow_return_missing)
} // namespace ncvet
