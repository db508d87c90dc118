// A number with two points, a sign in the middle, a blank inside or no digit.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {
namespace {

class SyntaxMalformedNumber final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::Syntax);
    if (to.dialect().facts->text.noMinusAtNumbers)
      to.on({EventKind::ToolWord, EventKind::SpeedWord, EventKind::OffsetWord});
    tight_ = to.dialect().facts->text.noBlanksInWords;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::Syntax)
      return signedNumber(*event.word, ctx);
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    SourceRange range = ctx.range(issue);
    const Block &block = ctx.block();
    switch (issue.kind) {
    case SyntaxIssueKind::MalformedNumber:
      // A block number with a point or sign is a number in itself: syntax-integer-required speaks.
      if (block.number >= 0 && issue.begin == block.numberBegin && issue.end == block.numberEnd &&
          (ctx.text(range).count('.') == 1 ||
           ctx.text(range).find_first_of("+-") != llvm::StringRef::npos))
        return;
      if (isLong(ctx.text(range))) // block-value-out-of-range speaks
        return;
      if (isLetterForZero(ctx.text(range)))
        return letterForZero(range, ctx);
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

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (tight_)
      blanksInWords(file, ctx);
  }

private:
  /// `X 44.`: words whose number is not right after its address.
  static void blanksInWords(const FileSummary &file, RuleContext &ctx) {
    const llvm::StringRef text = file.source.text();
    Block block;
    for (const SourceRange &reached : file.reached)
      for (size_t at = reached.begin; at + 2 < reached.end; ++at) {
        if (!llvm::isAlpha(text[at]) || (text[at + 1] != ' ' && text[at + 1] != '\t'))
          continue;
        const size_t digit = text.find_first_not_of(" \t", at + 1);
        if (digit == llvm::StringRef::npos || !(llvm::isDigit(text[digit]) || text[digit] == '.' ||
                                                text[digit] == '-' || text[digit] == '+'))
          continue;
        // In a comment there is no word at this place.
        file.reader.read(file.source.lines().lineBegin(uint32_t(at)), block);
        uint32_t end = block.numberBegin == at && block.number >= 0 ? block.numberEnd : 0;
        for (const Word &word : block.words)
          if (word.offset == at && word.isNumber())
            end = block.endOf(word);
        if (end <= digit)
          continue;
        const SourceRange range{file.source.id(), uint32_t(at), end};
        const llvm::StringRef word = text.slice(at, end);
        if (auto finding = ctx.report(range))
          finding.message("`{0}` has a blank between the address and its number", word)
              .severity(Severity::Warning)
              .fix(
                  FixSafety::Unsafe, "take the blank away",
                  ctx.replace(range, (word.take_front(1) + word.drop_front(1).ltrim(" \t")).str()));
      }
  }

  /// `YO`
  static bool isLetterForZero(llvm::StringRef text) {
    return text.size() == 2 && llvm::isAlpha(text[0]) && (text[1] | 32) == 'o';
  }

  static void letterForZero(SourceRange range, RuleContext &ctx) {
    const std::string due = (ctx.text(range).take_front(1) + "0").str();
    if (auto finding = ctx.report(range))
      finding.message("`{0}` has the letter O: `{1}` is due", ctx.text(range), due)
          .fix(FixSafety::Unsafe, "write `" + due + "`", ctx.replace(range, due));
  }

  /// A number that is one, but for its many digits.
  static bool isLong(llvm::StringRef text) {
    text = text.drop_front();
    text.consume_front("-");
    const size_t digits = llvm::count_if(text, llvm::isDigit);
    return digits > 8 && digits + text.count('.') == text.size() && text.count('.') < 2;
  }

  /// `T-1`: what is counted has no sign.
  static void signedNumber(const Word &word, RuleContext &ctx) {
    if (!word.isNumber() || !word.has(wordMinus))
      return;
    if (auto finding = ctx.report(word))
      finding.message("`{0}`: a minus at a number that takes no sign", ctx.text(word));
  }

  bool tight_ = false; ///< numbers are right after their addresses
};

} // namespace
NCVET_RULE(SyntaxMalformedNumber, syntax_malformed_number)
} // namespace ncvet
