// An expression that the control groups otherwise than it looks.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class SyntaxAmbiguousExpression final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Syntax); }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    if (issue.kind != SyntaxIssueKind::AmbiguousExpression)
      return;
    const SourceRange range = ctx.range(issue);
    const llvm::StringRef text = ctx.text(range);
    auto finding = ctx.report(range);
    if (!finding)
      return;
    if (text.find_first_of("=<>") != llvm::StringRef::npos || comparesByLetters(text))
      finding.message("in `{0}` AND, OR and NOT bind stronger than the comparisons: write each "
                      "comparison in brackets",
                      text);
    else if (text[0] == '-' && !text.contains("**"))
      finding.message("`{0}` is subtracted from the value before the blank: write it without the "
                      "blank, or as a word of its own",
                      text);
    else
      finding.message("no manual says in which order `{0}` is computed: write brackets", text);
  }

private:
  /// `#1 GT 3`
  static bool comparesByLetters(llvm::StringRef text) {
    return llvm::any_of(std::initializer_list<llvm::StringRef>{"EQ", "NE", "GT", "GE", "LT", "LE"},
                        [&](llvm::StringRef name) { return text.contains_insensitive(name); });
  }
};

} // namespace
NCVET_RULE(SyntaxAmbiguousExpression, syntax_ambiguous_expression)
} // namespace ncvet
