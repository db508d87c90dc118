// A letter that looks like a digit is inside a number.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

/// The digit that a letter looks like; 0 byte: none.
char digitFor(char letter) {
  switch (letter) {
  case 'O':
  case 'o':
    return '0';
  case 'l':
    return '1';
  case 'S':
    return '5';
  default:
    return 0;
  }
}

bool isSmall(char c) { return c >= 'a' && c <= 'z'; }
bool inNumber(char c) { return llvm::isDigit(c) || c == '.'; }

class SyntaxLookalikeCharacter final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on({EventKind::Syntax, EventKind::WordIssue}); }

  void on(const Event &event, RuleContext &ctx) const override {
    const llvm::StringRef all = ctx.source().text();
    const Block &block = ctx.block();
    if (event.kind == EventKind::Syntax) {
      // `XO.5`, `GO1`: the address lacks its value because the number begins with a letter.
      const SyntaxIssue &issue = block.issues[event.issue()];
      if (issue.kind != SyntaxIssueKind::MissingValue || issue.end + 1 >= all.size())
        return;
      if (digitFor(all[issue.end]) && inNumber(all[issue.end + 1]))
        report(issue.begin, issue.end, ctx);
      else if (issue.begin > block.begin && inNumber(all[issue.begin - 1]) &&
               isRound(all[issue.begin]))
        report(startOf(issue.begin, all), issue.begin, ctx); // `X1O.`
      return;
    }
    constexpr AddressMask others = lettersMask("ABCDEFGHIJKMNPQRSTUVWXYZ");
    if (event.wordIssue() != WordIssue::Special || !(block.addresses & ~others))
      return sleepInShape();
    for (const Word &word : block.words) {
      const char letter = all[word.offset];
      if ((letter != 'O' && letter != 'o' && letter != 'l') || word.offset <= block.begin ||
          word.address == keywordAddress) // what defines an element begins where its name does
        continue;
      const char before = all[word.offset - 1];
      // `g10l2`: a small L among small letters, with a number of its own, is the address.
      if (letter == 'l' && inNumber(before) && !word.has(wordNoValue) &&
          isSmall(letterBefore(word.offset, all)))
        continue;
      // The name of an element may follow the block's number without a space: `N40O5`.
      const bool element = ctx.dialect().elementWords & maskOf(word.address) && block.number >= 0 &&
                           word.offset == block.numberEnd;
      if ((inNumber(before) && !element) || before == '-')
        report(startOf(word.offset, all), word.offset, ctx); // `X1O5`, `Z-l0.`
    }
  }

private:
  static bool isRound(char c) { return c == 'O' || c == 'o' || c == 'l'; }

  /// The nearest letter before `at`; 0: there is none.
  static char letterBefore(uint32_t at, llvm::StringRef all) {
    while (at > 0 && !llvm::isAlpha(all[at - 1]))
      --at;
    return at > 0 ? all[at - 1] : '\0';
  }

  /// Beginning of the word whose number is broken off at `at`.
  static uint32_t startOf(uint32_t at, llvm::StringRef all) {
    while (at > 0 && (inNumber(all[at - 1]) || all[at - 1] == '-' || all[at - 1] == '+'))
      --at;
    return at > 0 && llvm::isAlpha(all[at - 1]) ? at - 1 : at;
  }

  static void report(uint32_t begin, uint32_t letter, RuleContext &ctx) {
    const llvm::StringRef all = ctx.source().text();
    const SourceRange range{ctx.source().id(), begin, letter + 1};
    const char digit = digitFor(all[letter]);
    auto finding = ctx.report(range);
    if (!finding || !digit)
      return;
    finding
        .message(
            "`{0}` has the letter {1} where the digit {2} is meant: the control reads another word",
            ctx.text(range), all.substr(letter, 1), std::string(1, digit))
        .fix(FixSafety::Unsafe, "put the digit",
             ctx.replace({ctx.source().id(), letter, letter + 1}, std::string(1, digit)));
  }
};

} // namespace
NCVET_RULE(SyntaxLookalikeCharacter, syntax_lookalike_character)
} // namespace ncvet
