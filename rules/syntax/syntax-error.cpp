// A statement, expression or run of letters that does not fit the control's grammar.
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct SyntaxErrorMemory {
  Aside<std::optional<uint32_t>> afterText; ///< where the last line of prose ends
  Aside<std::optional<uint32_t>> ifBlock;   ///< the block at which brackets of IF were told
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
    if (ctx.block().repeatsIssue(event.issue()) || isOfUnread(event.issue(), ctx.block()))
      return;
    const char *const what = meaning(issue, ctx);
    if (!what)
      return;
    const SourceRange range = ctx.range(issue);
    if (auto finding = ctx.report(range))
      finding.message(what, ctx.source().displayText(ctx.text(range).rtrim()));
  }

private:
  /// What comes after a word or a statement that the control cannot read is part of it.
  static bool isOfUnread(size_t number, const Block &block) {
    const auto isUnread = [](const SyntaxIssue &issue) {
      return issue.kind == SyntaxIssueKind::UnknownWord ||
             issue.kind == SyntaxIssueKind::BadStatement;
    };
    const SyntaxIssue &issue = block.issues[number];
    if (!isUnread(issue) && issue.kind != SyntaxIssueKind::BadExpression)
      return false;
    constexpr size_t most = 8; // that are looked at
    return llvm::any_of(llvm::makeArrayRef(block.issues).take_front(std::min(number, most)),
                        isUnread);
  }

  /// What is wrong; null: nothing, or another rule says it.
  const char *meaning(const SyntaxIssue &issue, const RuleContext &ctx) const {
    const bool noBrackets =
        ctx.dialect().lexical.commaSeparates || ctx.dialect().facts->text.bracketsApart;
    switch (issue.kind) {
    case SyntaxIssueKind::UnbalancedBracket: // syntax-unbalanced-brackets speaks
      return noBrackets ? nullptr : "`{0}` has no bracket to match it";
    case SyntaxIssueKind::BadExpression:
      if (namesLackedFunction(ctx, issue)) // syntax-unknown-name speaks
        return nullptr;
      return ofExpression(issue, ctx);
    case SyntaxIssueKind::BadStatement:
      return lacksAction(ctx, issue) ? nullptr : ofStatement(issue, ctx); // block-missing-word
    case SyntaxIssueKind::UnknownWord:
      return ctx.dialect().keywords.empty() ? ofWord(issue, ctx) : nullptr; // syntax-unknown-name
    case SyntaxIssueKind::NotABlock: {
      // Of lines of prose in a row only the first is reported.
      std::optional<uint32_t> &afterText = memory().afterText.look();
      const bool goesOn = ctx.block().begin == afterText;
      afterText = ctx.block().next;
      return goesOn ? nullptr
                    : ofNoBlock(ctx.dialect().lexical.commaSeparates ? ""
                                                                     : ctx.text(ctx.range(issue)));
    }
    default:
      return nullptr;
    }
  }

  /// The line may have been meant as a comment or as a calculation.
  static const char *ofNoBlock(llvm::StringRef line) {
    const size_t close = line.find(')'), open = line.find('(');
    if (close != llvm::StringRef::npos && open == llvm::StringRef::npos)
      return "a `)` without its `(`: the control reads the comment as a block, and stops";
    if (line.contains('#') && open != llvm::StringRef::npos && open &&
        llvm::isAlpha(line[open - 1]))
      return "this is no block: what a function computes is written in `[ ]`, and `( )` is a "
             "comment";
    return "this is no block: the control reads none of it and stops";
  }

  static const char *ofExpression(const SyntaxIssue &issue, const RuleContext &ctx) {
    if (issue.begin == issue.end)
      return "a value is missing here: the control stops";
    if (assignsInCondition(issue, ctx))
      return "`{0}`: `=` gives a value and compares nothing: `EQ` is meant";
    if (isOpenCondition(issue, ctx))
      return "`{0}`: a condition wants brackets around all of it: `[{0}]`";
    if (wantsBrackets(ctx, issue))
      return "`{0}` wants brackets around all of it: outside of brackets the control reads no "
             "operator";
    if (wantsTwoBrackets(ctx, issue))
      return "`{0}` is no expression that the control can compute: it reads `ATAN[y]/[x]`";
    return "`{0}` is no expression that the control can compute";
  }

  const char *ofStatement(const SyntaxIssue &issue, const RuleContext &ctx) const {
    if (isForeignIf(ctx, issue)) // where one lacks its number, others of the text do so too
      return tellsOfIf(ctx) ? "`{0}` is no statement that the control knows: its conditions are "
                              "written `o1 if [#1 GT 0]` .. `o1 endif`"
                            : nullptr;
    if (ctx.dialect().lexical.commaSeparates &&
        ctx.text(ctx.range(issue)).startswith_insensitive("STEP"))
      return "`{0}`: FOR counts by 1 and has no step; WHILE counts by any";
    if (const char *const lacks = ofDefinition(issue, ctx))
      return lacks;
    if (isPartedEnd(issue, ctx))
      return "`{0}` is one word: the control finds no end of the structure in two";
    if (!ctx.text(ctx.range(issue)).equals_insensitive("THEN"))
      return "`{0}` is no statement that the control knows";
    return tellsOfIf(ctx) ? "`{0}` without a statement after it: this control has no IF of several "
                            "blocks, nor ELSE and ENDIF"
                          : nullptr;
  }

  /// `DEF`, `PROC` alone; `PROC NAME SBLOF (..)`.
  static const char *ofDefinition(const SyntaxIssue &issue, const RuleContext &ctx) {
    const llvm::StringRef text = ctx.text(ctx.range(issue)).rtrim();
    if (text.equals_insensitive("DEF"))
      return "`{0}` has no type and no name after it: the control stops with an alarm";
    if (text.equals_insensitive("PROC"))
      return "`{0}` has no name after it: the control stops with an alarm";
    const bool list = text == "(" && llvm::any_of(ctx.block().items, [](const Item &item) {
                        return item.kind == ItemKind::Parameters;
                      });
    return list ? "`{0}`: the parameters of a program come before its attributes" : nullptr;
  }

  const char *ofWord(const SyntaxIssue &issue, const RuleContext &ctx) const {
    if (!isOfIf(ctx.text(ctx.range(issue))))
      return "`{0}` is neither a word of address and number nor a statement";
    if (!tellsOfIf(ctx))
      return nullptr;
    return ctx.dialect().lexical.flowWords
               ? "`{0}` is alone: the interpreter wants the number of its IF before it, "
                 "`o1 {0}`"
               : "`{0}`: this control has no IF of several blocks: an IF jumps, or has its "
                 "statement in its own block";
  }

  /// `END FOR`
  static bool isPartedEnd(const SyntaxIssue &issue, const RuleContext &ctx) {
    return llvm::any_of(ctx.block().items, [&](const Item &item) {
      return item.kind == ItemKind::Structure && item.begin == issue.begin &&
             closesBracket(item.structure) &&
             ctx.text(ctx.range(issue)).find_first_of(" \t") != llvm::StringRef::npos;
    });
  }

  /// Words of the IF of several blocks that other controls have.
  static bool isOfIf(llvm::StringRef word) {
    return word.equals_insensitive("ELSE") || word.equals_insensitive("ELSEIF") ||
           word.equals_insensitive("ENDIF");
  }

  /// One program that is written with such an IF: its first word is told.
  bool tellsOfIf(const RuleContext &ctx) const {
    std::optional<uint32_t> &told = memory().ifBlock.look();
    if (!told)
      told = ctx.block().begin;
    return told == ctx.block().begin;
  }

  /// `IF [#1 = 2] GOTO 10`
  static bool assignsInCondition(const SyntaxIssue &issue, const RuleContext &ctx) {
    const llvm::StringRef text = ctx.text(ctx.range(issue));
    const size_t sign = text.find('=');
    return sign != llvm::StringRef::npos && sign < text.find(']') && text.startswith("[") &&
           ctx.dialect().facts->variables.numbered &&
           llvm::any_of(ctx.block().items, [](const Item &item) {
             return item.kind == ItemKind::If || item.kind == ItemKind::While;
           });
  }

  /// `IF [#1] GE [2] GOTO 10`: the issue is all of the condition, and its first bracket ends
  /// before.
  static bool isOpenCondition(const SyntaxIssue &issue, const RuleContext &ctx) {
    return llvm::any_of(ctx.block().items, [&](const Item &item) {
      if ((item.kind != ItemKind::If && item.kind != ItemKind::While) ||
          item.condition >= ctx.block().expressions.size())
        return false;
      const SourceRange range = ctx.range(ctx.block().expressions[item.condition]);
      const llvm::StringRef text = ctx.text(range);
      if (!text.startswith("["))
        return text.startswith("#") && range.begin == issue.begin;
      int depth = 0;
      for (size_t i = 0; i < text.size(); ++i) {
        depth += text[i] == '[' ? 1 : text[i] == ']' ? -1 : 0;
        if (depth == 0)
          return range.begin == issue.begin && i + 1 < text.size();
      }
      return false;
    });
  }

  /// `#1 - #2`: operators beside values that are sound by themselves.
  static bool wantsBrackets(const RuleContext &ctx, const SyntaxIssue &issue) {
    const llvm::StringRef text = ctx.text(ctx.range(issue));
    if (ctx.dialect().lexical.arithmetic != Arithmetic::Ngc)
      return false;
    int depth = 0;
    for (size_t i = 0; i < text.size(); ++i) {
      depth += text[i] == '[' ? 1 : text[i] == ']' ? -1 : 0;
      if (i > 0 && depth == 0 && llvm::StringRef("+-*/").contains(text[i]) &&
          !text.startswith_insensitive("ATAN"))
        return true;
    }
    return false;
  }

  /// `ATAN[#1/#2]`
  static bool wantsTwoBrackets(const RuleContext &ctx, const SyntaxIssue &issue) {
    const llvm::StringRef text = ctx.text(ctx.range(issue)).ltrim("[ \t");
    return ctx.dialect().lexical.arithmetic == Arithmetic::Ngc &&
           text.startswith_insensitive("ATAN") && !text.contains("]/[");
  }

  /// `IF [#1 GT 2] GOTO 10`, where conditions are O-words.
  static bool isForeignIf(const RuleContext &ctx, const SyntaxIssue &issue) {
    return ctx.dialect().lexical.flowWords &&
           ctx.text(ctx.range(issue)).startswith_insensitive("IF");
  }

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
    if (!block.issues.empty())
      return;
    if (item.kind == ItemKind::Assignment && statementsAlone_)
      withoutThen(item, ctx);
    if (block.words.empty())
      return;
    if (item.kind == ItemKind::If && &item == &block.items.back() && statementsAlone_)
      return thenWords(item, ctx);
    if (!(loop || (other && statementsAlone_)))
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.severity(statementsAlone_ ? std::nullopt : std::optional(Severity::Warning))
          .message("`{0}` shares its block with words: the control takes statements in blocks of "
                   "their own",
                   ctx.text(range));
  }

  /// `IF [#1 GT 5] #2=0`
  static void withoutThen(const Item &item, RuleContext &ctx) {
    if (&item == ctx.block().items.begin())
      return;
    const Item &condition = *std::prev(&item);
    if (condition.kind != ItemKind::If ||
        ctx.source().text(condition.end, item.begin).contains_insensitive("THEN"))
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` after a condition: THEN has to be between them", ctx.text(range))
          .fix(FixSafety::Unsafe, "insert THEN", ctx.insertBefore(range.begin, "THEN "));
  }

  /// `IF [#1 EQ 2] THEN G00 X5.`, `IF [#1 EQ 2] M30`: words in the place of the statement.
  static void thenWords(const Item &item, RuleContext &ctx) {
    const Word &first = ctx.block().words.front();
    if (first.offset < item.end)
      return;
    const bool then = ctx.source().text(item.end, first.offset).contains_insensitive("THEN");
    if (auto finding = ctx.report(first))
      finding.severity(then ? std::nullopt : std::optional(Severity::Warning))
          .message(then ? "`{0}` after THEN: the control takes one statement of a macro there"
                        : "`{0}` after a condition: only GOTO, or THEN and a statement of a "
                          "macro, may follow it",
                   ctx.text(first));
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
