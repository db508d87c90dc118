// Compensation engages on the contour itself.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CompensationSoftApproachAdvised final : public Rule {
public:
  void listen(Subscriptions &to) override {
    const auto any = [&](auto wanted) { return llvm::any_of(to.dialect().codes, wanted); };
    pairs_ = any([](const CodeInfo &code) { return code.arrivesSoftly; });
    if (pairs_ || any([](const CodeInfo &code) { return code.action == Action::SoftApproach; }))
      to.onAction({Action::CompensationLeft, Action::CompensationRight});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (ctx.code(event).arrivesSoftly || (pairs_ && !ctx.asked()))
      return;
    if (ctx.before().compensation != phaseOff || !axesOf(ctx.dialect(), ctx.block()))
      return;
    for (const CodeUse &use : ctx.codes())
      if (ctx.code(use).action == Action::SoftApproach)
        return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` meets the contour on a straight line: a soft approach leaves no mark "
                   "on the part",
                   ctx.code(event).name)
          .severity(pairs_ ? std::optional(Severity::Style) : std::nullopt);
  }

private:
  /// The same codes of compensation are there with an arc and without: advice for who asks for it.
  bool pairs_ = false;
};

} // namespace
NCVET_RULE(CompensationSoftApproachAdvised, compensation_soft_approach_advised)
} // namespace ncvet
