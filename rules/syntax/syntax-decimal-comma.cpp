// A comma as the decimal sign, on a control where commas open words of their own.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class SyntaxDecimalComma final : public Rule {
public:
  void listen(Subscriptions &to) override {
    // Elsewhere a comma is no character of the language: syntax-invalid-character speaks.
    if (to.dialect().lexical.commaAddresses || to.dialect().lexical.commaSeparates)
      to.on(EventKind::Syntax);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    if (issue.kind != SyntaxIssueKind::DecimalComma)
      return;
    const SourceRange range = ctx.range(issue);
    const llvm::StringRef text = ctx.text(range);
    if (auto finding = ctx.report(range)) {
      finding.message("`{0}` has a decimal comma: a comma opens another word, the fraction is lost",
                      text);
      const size_t comma = text.find(',');
      if (comma != llvm::StringRef::npos) {
        const auto at = uint32_t(range.begin + comma);
        finding.fix(FixSafety::Unsafe, "write a decimal point",
                    ctx.replace({range.file, at, at + 1}, "."));
      }
    }
  }
};

} // namespace
NCVET_RULE(SyntaxDecimalComma, syntax_decimal_comma)
} // namespace ncvet
