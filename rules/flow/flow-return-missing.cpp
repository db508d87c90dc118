// A called program does not come to its return.
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class FlowReturnMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FlowIssue);
    endCounts_ = to.dialect().facts->program.noEndInSubprogram;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const auto issue = event.flowIssue();
    const bool endCode = issue == FlowIssue::EndInSubprogram && endCounts_;
    // A file that says itself to be a subprogram needs its return without a caller too.
    const bool alone = issue == FlowIssue::MainRunsOut &&
                       ctx.index().programAt(ctx.flowRange().begin).kind == ProgramKind::Subprogram;
    if (issue != FlowIssue::SubprogramRunsOut && !endCode && !alone)
      return;
    auto finding = ctx.report(ctx.flowRange(), event.certain);
    if (!finding)
      return;
    const std::string back = returnOf(ctx.dialect());
    if (endCode)
      finding.message("`{0}` ends the job inside a called program: `{1}` returns to the caller",
                      ctx.text(ctx.flowRange()), back);
    else
      finding
          .message("the called program ends without `{0}`: {1}", back,
                   ctx.dialect().endReturns
                       ? "some versions of the control stop here, others return"
                       : "the control does not find back")
          .fix(FixSafety::Unsafe, "insert `" + back + "` after this block",
               TextEdit{{ctx.flowRange().file, ctx.flowRange().end, ctx.flowRange().end},
                        "\n" + back});
  }

private:
  bool endCounts_ = false;
};

} // namespace
NCVET_RULE(FlowReturnMissing, flow_return_missing)
} // namespace ncvet
