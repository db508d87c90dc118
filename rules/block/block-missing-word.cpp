// A code without a word that it requires.
#include "analyzer/facts/word_checks.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <map>

namespace ncvet {
namespace {

bool isMine(const CodeInfo &code, const WordSpec &spec) {
  return topicOf(code, spec) == WordTopic::Block;
}

struct BlockMissingWordMemory {
  /// Of codes that do nothing without the word, and no harm: where each was told.
  std::map<CodeIndex, TextPlace> harmless;
};

class BlockMissingWord final : public StatefulRule<BlockMissingWordMemory> {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    to.on(EventKind::Syntax);
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Sleep ||
             llvm::any_of(code.words,
                          [&](const WordSpec &spec) {
                            return spec.need != Need::Optional && isMine(code, spec);
                          }) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Syntax)
      return withoutAction(ctx.block().issues[event.issue()], ctx);
    ctx.reportNotices(id, event);
    if (ctx.code(event).action == Action::Sleep && !hasTime(*event.word, ctx))
      if (auto finding = ctx.report(event))
        finding.message("`{0}` has no time after it: four digits, hours and minutes",
                        ctx.text(*event.word));
    // A bare axis letter is a word: reference returns name their axes so.
    const bool byName = namesAxes(ctx);
    // `G65 <NAME>`
    const bool named = ctx.block().nameEnd > ctx.block().nameBegin;
    reportMissingWords(ctx, event, [&](const CodeInfo &code, const WordSpec &spec) {
      return isMine(code, spec) && (spec.severity != Severity::Style || isFirst(event, ctx)) &&
             !(byName && spec.any & ctx.dialect().axisWords) &&
             !(named && spec.role == Role::Program);
    });
    if (!named && isByShape(ctx.code(event)))
      sleepInShape();
  }

private:
  static constexpr llvm::StringLiteral id{"block-missing-word"};

  /// The first block of the program with the code for which a remark is due.
  bool isFirst(const Event &event, const RuleContext &ctx) const {
    const TextPlace here{ctx.source().id(), ctx.block().begin};
    return ctx.asked() || memory().harmless.try_emplace(event.code, here).first->second == here;
  }

  /// Whether no number of the block decides what is missing.
  static bool isByShape(const CodeInfo &code) {
    return code.action != Action::Sleep && !asksNumbers(code, id) &&
           llvm::none_of(code.words, [](const WordSpec &spec) { return asksNumber(spec.when); });
  }

  /// `WHEN $A_IN[1]==1`, and no DO.
  static void withoutAction(const SyntaxIssue &issue, RuleContext &ctx) {
    if (!lacksAction(ctx, issue))
      return;
    const SourceRange range = ctx.range(issue);
    llvm::StringRef rest = ctx.source().text(range.end, ctx.block().end);
    const bool has = rest.ltrim().consume_front_insensitive("DO");
    if (auto finding = ctx.report(range))
      finding.message(
          has ? "`{0}` has a `DO` without an action after it: the control stops with an "
                "alarm"
              : "`{0}` needs `DO` and what to do then, and its block has none: the "
                "control stops with an alarm",
          ctx.source().displayText(ctx.text(range)));
  }

  /// `AX[FIRST]=20`: an axis whose name a variable holds.
  static bool namesAxes(const RuleContext &ctx) {
    return llvm::any_of(ctx.block().items, [&](const Item &item) {
      return item.kind == ItemKind::Assignment && ctx.text(ctx.range(item)).contains('[');
    });
  }

  /// The time of a sleep code is a comment of four digits after it, a bare number or any word.
  static bool hasTime(const Word &code, const RuleContext &ctx) {
    const Block &block = ctx.block();
    for (const Comment &comment : block.comments) {
      if (comment.begin < code.offset)
        continue;
      const llvm::StringRef text = ctx.text(ctx.range(comment)).trim("() ");
      if (text.size() == 4 && llvm::all_of(text, llvm::isDigit))
        return true;
    }
    return llvm::any_of(
               block.issues,
               [](const SyntaxIssue &i) { return i.kind == SyntaxIssueKind::MissingAddress; }) ||
           block.words.size() > ctx.codes().size();
  }
};

} // namespace
NCVET_RULE(BlockMissingWord, block_missing_word)
} // namespace ncvet
