// A number with two points, a sign in the middle, a blank inside or no digit.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class SyntaxMalformedNumber final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Syntax); }

  void on(const Event &event, RuleContext &ctx) override {
    const SyntaxIssue &issue = ctx.block().issues[size_t(event.number)];
    SourceRange range{ctx.source().id(), issue.begin, issue.end};
    const Block &block = ctx.block();
    switch (issue.kind) {
    case SyntaxIssueKind::MalformedNumber:
      // A block number with a point or sign is a number in itself: syntax-integer-required speaks.
      if (block.number >= 0 && issue.begin == block.numberBegin && issue.end == block.numberEnd &&
          (ctx.text(range).count('.') == 1 || ctx.text(range).contains('-')))
        return;
      if (auto finding = ctx.report(range))
        finding.message(
            "`{0}` is no number: one sign, one decimal point and at least one digit are due",
            ctx.text(range));
      return;
    case SyntaxIssueKind::BlankInNumber: {
      // Up to the end of the number, of which the issue names the first digit.
      const llvm::StringRef all = ctx.source().text();
      while (range.end < block.end && (llvm::isDigit(all[range.end]) || all[range.end] == '.'))
        ++range.end;
      auto finding = ctx.report(range);
      if (!finding)
        return;
      std::string joined;
      for (const char c : ctx.text(range))
        if (c != ' ' && c != '\t')
          joined += c;
      finding.message("`{0}` has a blank inside the number", ctx.text(range))
          .severity(Severity::Warning)
          .fix(FixSafety::Unsafe, "take the blank away", ctx.replace(range, joined));
      return;
    }
    default:
      return;
    }
  }
};

} // namespace
NCVET_RULE(SyntaxMalformedNumber, syntax_malformed_number)
} // namespace ncvet
