// An address without a number, or a number without an address.
#include "analyzer/facts/foreign_block.h"
#include "formats/dialect/control_facts.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {
namespace {

class SyntaxIncompleteWord final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::Syntax);
    noBareAxes_ = to.dialect().facts->text.noBareAxes;
    limitAxes_ = to.dialect().facts->text.bareAxesOfLimits;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    const SourceRange range = ctx.range(issue);
    if (issue.kind == SyntaxIssueKind::MissingAddress) {
      // A sleep code takes its time as a bare number.
      if (ctx.find({Action::Sleep}) || holdsForeignCode(ctx) ||
          ctx.block().repeatsIssue(event.issue()))
        return;
      return withoutAddress(range, ctx);
    }
    if (issue.kind != SyntaxIssueKind::MissingValue || mayBeBare(issue, ctx))
      return;
    // The first such word of a block speaks for the others.
    for (size_t i = 0; i < event.issue(); ++i) {
      const SyntaxIssue &other = ctx.block().issues[i];
      if (other.kind == SyntaxIssueKind::MissingValue && !mayBeBare(other, ctx))
        return;
    }
    const llvm::StringRef put = placeHolder(range.end, ctx);
    auto finding = ctx.report(range);
    if (finding && !put.empty())
      finding.severity(Severity::Style)
          .message("`{0}` has no value after it: `{1}` looks like what a program puts there",
                   ctx.text(range), put);
    else if (finding)
      finding.message("`{0}` has no value after it", ctx.text(range));
  }

private:
  static void withoutAddress(const SourceRange &range, RuleContext &ctx) {
    auto finding = ctx.report(range);
    if (!finding)
      return;
    if (!isNumberOfProgram(range, ctx)) {
      finding.message("`{0}` has no address before it", ctx.text(range));
      return;
    }
    const SourceRange zero{range.file, range.begin, range.begin + 1};
    finding
        .message("`{0}` has no address before it: the digit 0 is in the place of the letter O",
                 ctx.text(range))
        .fix(FixSafety::Unsafe, "write the letter O", ctx.replace(zero, "O"));
  }

  /// `01000`, the first thing of a text.
  static bool isNumberOfProgram(const SourceRange &range, const RuleContext &ctx) {
    const llvm::StringRef text = ctx.text(range);
    return text.size() == 5 && text.startswith("0") && llvm::all_of(text, llvm::isDigit) &&
           (ctx.dialect().known & maskOf(letterAddress('O'))) &&
           ctx.source().text(0, range.begin).trim(" \t\r\n%").empty();
  }

  /// `F(BASE_FEED)`: directly after the address a comment that is one word in capitals.
  static llvm::StringRef placeHolder(uint32_t after, const RuleContext &ctx) {
    const llvm::StringRef rest = ctx.source().text(after, ctx.block().end);
    const size_t close = rest.find(')');
    if (!rest.startswith("(") || close == llvm::StringRef::npos)
      return {};
    const llvm::StringRef word = rest.slice(1, close);
    const bool isName = word.contains('_') && llvm::all_of(word, [](char c) {
                          return llvm::isDigit(c) || (c >= 'A' && c <= 'Z') || c == '_';
                        });
    return isName ? rest.take_front(close + 1) : llvm::StringRef();
  }

  /// Axis letters alone name the axes of a reference return, on some controls those of a limit too;
  /// an unknown letter has its own rule.
  bool mayBeBare(const SyntaxIssue &issue, const RuleContext &ctx) const {
    for (const Word &word : ctx.block().words) {
      if (word.offset != issue.begin)
        continue;
      const AddressMask mask = maskOf(word.address);
      return !(ctx.dialect().known & mask) ||
             ((ctx.dialect().axisWords & mask) &&
              ((!noBareAxes_ && ctx.find({Action::ReferenceReturn})) ||
               (limitAxes_ && ctx.find({Action::ZoneOn}))));
    }
    return false;
  }

  bool limitAxes_ = false;  ///< `G25 X Y` gives the limits of these axes up
  bool noBareAxes_ = false; ///< a reference return does not take axis letters alone
};

} // namespace
NCVET_RULE(SyntaxIncompleteWord, syntax_incomplete_word)
} // namespace ncvet
