// A character outside comments that the control cannot read.
#include "analyzer/rule/rule.h"

#include <utility>

namespace ncvet {
namespace {

struct SyntaxInvalidCharacterMemory {
  bool quoteSpoken = false;
};

class SyntaxInvalidCharacter final : public StatefulRule<SyntaxInvalidCharacterMemory> {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Syntax); }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    const SourceRange range = ctx.range(issue);
    const std::string text = ctx.source().displayText(ctx.text(range));
    switch (issue.kind) {
    case SyntaxIssueKind::InvalidCharacter:
      if (ctx.block().repeatsIssue(event.issue()))
        return;
      if (auto finding = ctx.report(range))
        finding.message("`{0}` cannot be read by the control outside comments", text);
      return;
    case SyntaxIssueKind::TypographicQuote:
      if (std::exchange(memory().quoteSpoken, true)) // a word processor makes all of them so
        return;
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Warning)
            .message("`{0}` is a typographic quotation mark: the control knows the straight one",
                     text)
            .fix(FixSafety::Safe, "write a straight one", ctx.replace(range, "\""));
      return;
    case SyntaxIssueKind::TypographicMinus:
      if (auto finding = ctx.report(range))
        finding
            .message("`{0}` is a typographic dash: the control drops it, and the sign with it",
                     text)
            .fix(FixSafety::Safe, "write a minus", ctx.replace(range, "-"));
      return;
    case SyntaxIssueKind::DecimalComma: {
      // Where commas open words of their own, syntax-decimal-comma speaks.
      if (ctx.dialect().lexical.commaAddresses || ctx.dialect().lexical.commaSeparates)
        return;
      const size_t comma = ctx.text(range).find(',');
      const auto at = uint32_t(range.begin + (comma == llvm::StringRef::npos ? 0 : comma));
      if (auto finding = ctx.report(SourceRange{range.file, at, at + 1}))
        finding
            .message("the comma in `{0}` cannot be read by the control: decimals follow a point",
                     text)
            .fix(FixSafety::Unsafe, "write a decimal point",
                 ctx.replace({range.file, at, at + 1}, "."));
      return;
    }
    default:
      return;
    }
  }
};

} // namespace
NCVET_RULE(SyntaxInvalidCharacter, syntax_invalid_character)
} // namespace ncvet
