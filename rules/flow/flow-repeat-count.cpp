// The repeat count of a call is not a whole number of runs.
#include "analyzer/rule.h"

#include <cmath>

namespace ncvet {
namespace {

class FlowRepeatCount final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::CallProgram, Action::CallLocal, Action::MacroCall});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const Word *count = ctx.block().find('L');
    if (!count || count->has(wordNoValue))
      return;
    const Interval value = ctx.value(*count);
    if (!value.isConstant())
      return;
    const double runs = value.value();
    if (runs >= 1 && runs == std::floor(runs))
      return;
    // None on purpose: a call that is switched off for a while, or by a computed count.
    const bool none = runs == 0;
    if (none && count->has(wordExpression))
      return;
    if (auto finding = ctx.report(*count))
      finding.message("`{0}` is no number of runs for `{1}`: {2}", ctx.text(*count),
                      ctx.code(event).name,
                      none ? "the control makes none, or one all the same"
                           : "it has to be a whole number from 1 on");
  }
};

} // namespace
NCVET_RULE(FlowRepeatCount, flow_repeat_count)
} // namespace ncvet
