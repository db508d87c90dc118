// An axis word whose variable was never set.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/evaluate/expression.h"

namespace ncvet {
namespace {

class VariableNullAsCoordinate final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Motion, EventKind::CycleRun}); }

  void on(const Event &, RuleContext &ctx) const override {
    // In a called macro a word without an argument is left out on purpose.
    if (ctx.callDepth() > 0)
      return;
    if (ctx.block().expressions.empty())
      return sleepInShape();
    for (const Word &word : ctx.block().words)
      if ((ctx.dialect().axisWords & maskOf(word.address)) && word.has(wordExpression) &&
          evaluate(ctx.block(), uint16_t(word.mantissa), ctx.before(), nullptr).isVacant())
        if (auto finding = ctx.report(word))
          finding.message("the variable of `{0}` was never set: the control leaves the word out "
                          "and the axis stays",
                          ctx.text(word));
  }
};

} // namespace
NCVET_RULE(VariableNullAsCoordinate, variable_null_as_coordinate)
} // namespace ncvet
