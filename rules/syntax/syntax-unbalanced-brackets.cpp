// Brackets, parentheses or quotation marks that are not closed, in languages of calls.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class SyntaxUnbalancedBrackets final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().lexical.commaSeparates || to.dialect().facts->text.bracketsApart)
      to.on(EventKind::Syntax);
    strings_ = to.flag("strings", true);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    const char *what = nullptr;
    switch (issue.kind) {
    case SyntaxIssueKind::UnbalancedBracket:
      what = ctx.dialect().facts->text.bracketsApart
                 ? "`{0}` has no bracket to match it"
                 : "`{0}` is not closed: the control cannot tell where it ends";
      break;
    case SyntaxIssueKind::StrayParenthesis:
      what = "`{0}` closes what nothing has opened";
      break;
    case SyntaxIssueKind::UnclosedString:
      if (!strings_)
        return;
      what = "the string `{0}` has no closing quotation mark";
      break;
    default:
      return;
    }
    const SourceRange range = ctx.range(issue);
    if (auto finding = ctx.report(range))
      finding.message(what, ctx.source().displayText(ctx.text(range)));
  }

private:
  bool strings_ = true; ///< false: syntax-unclosed-comment tells them
};

} // namespace
NCVET_RULE(SyntaxUnbalancedBrackets, syntax_unbalanced_brackets)
} // namespace ncvet
