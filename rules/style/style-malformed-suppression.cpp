// A suppression comment that ncvet cannot follow: an unknown word, or a rule that does not exist.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/rule_settings.h"

namespace ncvet {
namespace {

class StyleMalformedSuppression final : public Rule {
public:
  void listen(Subscriptions &) override {}

  void finish(const FileSummary &summary, RuleContext &ctx) const override {
    for (const Suppression &suppression : summary.index.suppressions(rulesCalled)) {
      if (suppression.verb == SuppressionVerb::Unknown) {
        if (auto finding = ctx.report(suppression.verbRange))
          finding.text("the comment suppresses nothing: write `allow`, `off`, `on` or "
                       "`allow-file` after `ncvet:`");
        continue;
      }
      if (suppression.names.empty())
        if (auto finding = ctx.report(suppression.verbRange))
          finding.message("`{0}` suppresses nothing: it names no rule",
                          ctx.text(suppression.verbRange));
      for (const SuppressedName &name : suppression.names)
        if (name.rules.empty())
          if (auto finding = ctx.report(name.range))
            finding.message("the comment suppresses nothing: there is no rule `{0}`",
                            ctx.text(name.range).lower());
    }
  }
};

} // namespace
NCVET_RULE(StyleMalformedSuppression, style_malformed_suppression)
} // namespace ncvet
