// Compensation engages on the contour itself.
#include "analyzer/rule.h"
#include "analyzer/soft_approach.h"

namespace ncvet {
namespace {

class CompensationSoftApproachAdvised final : public Rule {
public:
  void listen(Subscriptions &to) override {
    soft_ = softApproaches(to.dialect());
    if (!soft_.empty())
      to.onAction({Action::CompensationLeft, Action::CompensationRight});
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (ctx.before().compensation != phaseOff || !axesOf(ctx.dialect(), ctx.block()))
      return;
    for (const CodeUse &use : ctx.codes())
      if (llvm::is_contained(soft_, ctx.code(use).base))
        return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` meets the contour on a straight line: a soft approach leaves no mark "
                      "on the part",
                      ctx.code(event).name);
  }

private:
  llvm::SmallVector<CodeIndex, 4> soft_;
};

} // namespace
NCVET_RULE(CompensationSoftApproachAdvised, compensation_soft_approach_advised)
} // namespace ncvet
