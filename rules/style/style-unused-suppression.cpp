// A suppression comment that suppresses nothing. Comments that cannot cover anything are found
// here; those that could but do not, by the step that applies them when all rules have run.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/rule_settings.h"

namespace ncvet {
namespace {

class StyleUnusedSuppression final : public Rule {
public:
  void listen(Subscriptions &) override {}

  void finish(const FileSummary &summary, RuleContext &ctx) const override {
    for (const Suppression &suppression : summary.index.suppressions(rulesCalled))
      for (const SuppressedName &name : suppression.names)
        if (name.dead)
          if (auto finding = ctx.report(name.range))
            finding.text(reason(suppression.verb));
  }

private:
  static std::string reason(SuppressionVerb verb) {
    switch (verb) {
    case SuppressionVerb::On:
      return "`on` changes nothing: the rule is not off here";
    case SuppressionVerb::Off:
      return "`off` changes nothing: the rule is off already";
    default:
      return "the comment suppresses nothing: no block follows";
    }
  }
};

} // namespace
NCVET_RULE(StyleUnusedSuppression, style_unused_suppression)
} // namespace ncvet
