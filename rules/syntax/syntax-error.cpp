// A statement, expression or run of letters that does not fit the control's grammar.
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"
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
    const ControlFacts &facts = *to.dialect().facts;
    oneSeparator_ = facts.text.oneSeparator;
    statementsAlone_ = facts.text.statementsAlone;
    loopsAlone_ = facts.text.loopsAlone;
    if (oneSeparator_ || statementsAlone_ || loopsAlone_)
      to.on(EventKind::Statement);
    brackets_ = facts.limits.bracketDepth;
    if (brackets_)
      to.onChange({EventKind::Block});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Block) {
      if (ctx.block().expressions.empty())
        return sleepInShape();
      sleepAtBlock();
      return depth(ctx);
    }
    if (event.kind == EventKind::Statement) {
      sleepAtBlock();
      const Item &item = ctx.block().items[event.item()];
      if (oneSeparator_)
        separators(item, ctx);
      if (statementsAlone_ || loopsAlone_)
        besideWords(item, ctx);
      return;
    }
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    if (ctx.block().repeatsIssue(event.issue()))
      return;
    const char *what = nullptr;
    switch (issue.kind) {
    case SyntaxIssueKind::UnbalancedBracket:
      if (ctx.dialect().lexical.commaSeparates ||
          ctx.dialect().facts->text.bracketsApart) // syntax-unbalanced-brackets speaks
        return;
      what = "`{0}` has no bracket to match it";
      break;
    case SyntaxIssueKind::BadExpression:
      if (namesLackedFunction(ctx, issue)) // syntax-unknown-name speaks
        return;
      what = "`{0}` is no expression that the control can compute";
      break;
    case SyntaxIssueKind::BadStatement:
      if (lacksAction(ctx, issue)) // block-missing-word speaks
        return;
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
  bool oneSeparator_ = false;
  bool statementsAlone_ = false; ///< no words beside assignments, jumps and loops
  bool loopsAlone_ = false;      ///< no words beside the brackets of loops
  unsigned brackets_ = 0;        ///< brackets in each other that the control takes; 0: any number

  /// A statement among words: the control takes the one or the other.
  void besideWords(const Item &item, RuleContext &ctx) const {
    const Block &block = ctx.block();
    const bool loop =
        item.kind == ItemKind::While || item.kind == ItemKind::Do || item.kind == ItemKind::End;
    const bool other = item.kind == ItemKind::Assignment || item.kind == ItemKind::Jump;
    if (block.words.empty() || !block.issues.empty() || !(loop || (other && statementsAlone_)))
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.severity(statementsAlone_ ? std::nullopt : std::optional(Severity::Warning))
          .message("`{0}` shares its block with words: the control takes statements in blocks of "
                   "their own",
                   ctx.text(range));
  }

  /// More brackets in each other than the control follows. Those that a condition needs do not
  /// count.
  void depth(RuleContext &ctx) const {
    const Block &block = ctx.block();
    for (const Expression &expression : block.expressions) {
      const llvm::StringRef text = ctx.text(ctx.range(expression));
      const bool condition = llvm::any_of(block.items, [&](const Item &item) {
        return item.condition != noExpression && &block.expressions[item.condition] == &expression;
      });
      const unsigned most = brackets_ + condition;
      unsigned open = 0;
      for (size_t i = 0; i < text.size(); ++i) {
        open += text[i] == '[';
        open -= text[i] == ']' && open;
        if (open <= most)
          continue;
        const auto at = uint32_t(expression.begin + i);
        if (auto finding = ctx.report(SourceRange{ctx.source().id(), at, at + 1}))
          finding.message("a bracket inside {0} others: the control follows {1}", open - 1,
                          brackets_);
        return;
      }
    }
  }

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
