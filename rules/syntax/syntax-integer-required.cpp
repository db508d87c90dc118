// A word that takes a whole number has a fraction or a decimal point.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/number_text.h"
#include "interp/evaluate/expression.h"

#include <cmath>

namespace ncvet {
namespace {

/// Words that name a block, a program or a method: whole numbers without a point.
bool namesSomething(Role role) {
  return role == Role::ProfileFirst || role == Role::ProfileLast || role == Role::Sequence ||
         role == Role::Program || role == Role::Method;
}

class SyntaxIntegerRequired final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::WordIssue, EventKind::Syntax, EventKind::Statement});
    codes_ = to.dialect().facts->text.wholeCodes;
    dropsPoint_ = to.flag("dropsPoint");
    if (to.flag("converted"))
      to.on(EventKind::ToolWord);
    to.onCode([](const CodeInfo &code) {
      return llvm::any_of(code.words, [](const WordSpec &w) { return namesSomething(w.role); });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    if (event.kind == EventKind::Statement) {
      passes(block.items[event.item()], ctx);
      return variable(block.items[event.item()], ctx);
    }
    if (event.kind == EventKind::Syntax) {
      const SyntaxIssue &issue = block.issues[event.issue()];
      if (issue.kind == SyntaxIssueKind::RealForInteger) {
        const SourceRange range = ctx.range(issue);
        if (auto finding = ctx.report(range))
          finding.message("`{0}` takes a whole number, and this value is a real one: a function "
                          "that cuts the fraction off makes it whole",
                          ctx.text(range));
        return;
      }
      if (issue.kind == SyntaxIssueKind::MalformedNumber && block.number >= 0 &&
          issue.begin == block.numberBegin && issue.end == block.numberEnd) {
        const SourceRange range = ctx.range(issue);
        if (ctx.text(range).count('.') == 1 ||
            ctx.text(range).find_first_of("+-") != llvm::StringRef::npos)
          if (auto finding = ctx.report(range))
            finding.message("`{0}`: a block number is a whole number without a sign or point",
                            ctx.text(range));
      }
      return;
    }
    if (event.kind == EventKind::ToolWord)
      return computed(*event.word, ctx);
    if (event.kind == EventKind::WordIssue) {
      if (event.wordIssue() != WordIssue::PointInWhole)
        return sleepInShape();
      if (ctx.find({Action::MacroCall, Action::MacroModal}))
        return;
      for (const Word &word : block.words)
        if (word.has(wordPoint) && ctx.dialect().whole & maskOf(word.address) && !isCode(word, ctx))
          report(word, ctx);
      return;
    }
    const CodeInfo &code = ctx.code(event);
    for (const WordSpec &spec : code.words) {
      if (!namesSomething(spec.role) || !(spec.any & block.pointed))
        continue;
      for (const Word &word : block.words)
        if (spec.any & maskOf(word.address) && word.has(wordPoint))
          report(word, ctx);
    }
  }

private:
  /// `T=R5`: R5 is a real, and only a conversion makes a whole number of it.
  static void computed(const Word &word, RuleContext &ctx) {
    const Block &block = ctx.block();
    if (!word.has(wordExpression) || size_t(word.mantissa) >= block.expressions.size())
      return;
    const Expression &e = block.expressions[size_t(word.mantissa)];
    if (e.bad || e.count == 0 || block.operations[e.first + e.count - 1].op == Op::Truncate ||
        (e.count == 1 && block.operations[e.first].op == Op::Number))
      return;
    if (auto finding = ctx.report(word))
      finding.message("`{0}` takes a whole number: a real value has to be converted",
                      ctx.text(word));
  }

  /// `<%NHL=2.5>`: the mark before the name says that it holds whole numbers.
  static void variable(const Item &item, RuleContext &ctx) {
    const SourceRange name{ctx.source().id(), item.nameBegin, item.nameEnd};
    if (item.kind != ItemKind::Assignment || item.value == noExpression ||
        !ctx.text(name).startswith("%"))
      return sleepAtBlock();
    const Value value = evaluateInBlock(ctx.block(), item.value, ctx.before());
    if (!value.isConstant() || value.number.value() == std::floor(value.number.value()))
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` holds whole numbers, and gets {1}", ctx.text(name),
                   shortNumber(value.number.value()));
  }

  /// `PART P2.5`: the number of passes of a program that is called by its name.
  void passes(const Item &item, RuleContext &ctx) const {
    if (codes_ != 1 || item.kind != ItemKind::Call)
      return;
    const auto count = ctx.block().numberIn(item.count);
    if (!count || *count == std::floor(*count))
      return;
    const SourceRange range = ctx.range(ctx.block().expressions[item.count]);
    if (auto finding = ctx.report(range))
      finding.message("`P{0}` is no number of passes: it has to be whole", ctx.text(range));
  }

  double codes_ = 0; ///< codes are whole numbers too: 1 all, 2 those that exist

  /// `G84.2` is a code with its digit after the point; an unknown code has its own rule.
  bool isCode(const Word &word, const RuleContext &ctx) const {
    if (ctx.dialect().addresses[word.address].kind != AddressKind::Code || word.decimals == 0)
      return false;
    return codes_ < 1 || (codes_ > 1 && codeOf(ctx.dialect(), word) == noCode);
  }

  bool dropsPoint_ = false; ///< `G54.` is read as G54

  void report(const Word &word, RuleContext &ctx) const {
    auto finding = ctx.report(word);
    if (!finding)
      return;
    if (dropsPoint_ && word.decimals == 0 &&
        ctx.dialect().addresses[word.address].kind == AddressKind::Code)
      finding.severity(Severity::Style);
    finding.message("`{0}` takes a whole number without a decimal point", ctx.text(word));
    if (word.decimals == 0)
      finding.fix(FixSafety::Unsafe, "take the decimal point away",
                  ctx.replace(ctx.range(word), ctx.text(word).rtrim('.')));
  }
};

} // namespace
NCVET_RULE(SyntaxIntegerRequired, syntax_integer_required)
} // namespace ncvet
