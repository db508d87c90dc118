// A statement, expression or run of letters that does not fit the control's grammar.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct SyntaxErrorMemory {
  Aside<std::optional<uint32_t>> afterText; ///< where the last line of prose ends
};

class SyntaxError final : public StatefulRule<SyntaxErrorMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::Syntax);
    if (to.dialect().facts->text.oneSeparator)
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return separators(ctx.block().items[event.item()], ctx);
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    if (ctx.block().repeatsIssue(event.issue()))
      return;
    const char *what = nullptr;
    switch (issue.kind) {
    case SyntaxIssueKind::UnbalancedBracket:
      if (ctx.dialect().lexical.commaSeparates) // syntax-unbalanced-brackets speaks
        return;
      what = "`{0}` has no bracket to match it";
      break;
    case SyntaxIssueKind::BadExpression:
      what = "`{0}` is no expression that the control can compute";
      break;
    case SyntaxIssueKind::BadStatement:
      what = "`{0}` is no statement that the control knows";
      break;
    case SyntaxIssueKind::UnknownWord:
      if (!ctx.dialect().keywords.empty()) // syntax-unknown-name speaks
        return;
      what = "`{0}` is neither a word of address and number nor a statement";
      break;
    case SyntaxIssueKind::NotABlock: {
      // Of lines of prose in a row only the first is reported.
      std::optional<uint32_t> &afterText = memory().afterText.look();
      const bool goesOn = ctx.block().begin == afterText;
      afterText = ctx.block().next;
      if (goesOn)
        return;
      what = "this is no block: the control reads none of it and stops";
      break;
    }
    default:
      return;
    }
    const SourceRange range = ctx.range(issue);
    if (auto finding = ctx.report(range))
      finding.message(what, ctx.source().displayText(ctx.text(range)));
  }

private:
  /// Arguments of one instruction that are separated by `;` and by `,`.
  static void separators(const Item &item, RuleContext &ctx) {
    char first = 0;
    for (const Argument &argument : ctx.block().argumentsOf(item)) {
      if (!argument.separator || argument.separator == first)
        continue;
      if (!first) {
        first = argument.separator;
        continue;
      }
      const SourceRange range = ctx.range(item);
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Style)
            .message("`{0}` separates its arguments by `;` and by `,`: one of them reads better",
                     ctx.text(range));
      return;
    }
  }
};

} // namespace
NCVET_RULE(SyntaxError, syntax_error)
} // namespace ncvet
