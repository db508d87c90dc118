// Tool and offset numbers that the machine profile's list does not have.
#include "analyzer/rule/rule.h"
#include "interp/evaluate/tool_data.h"

namespace ncvet {
namespace {

class ToolNotInList final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::ToolWord);
    greatest_ = to.number("greatestOffset", 0);
    // Offsets that belong to tools have numbers of their own, or those of tools.
    ofTools_ = to.dialect().offsetsOfTool && cutterOfBlock(to.dialect());
    if (!to.dialect().offsetsOfTool || ofTools_)
      to.on(EventKind::OffsetWord);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (greatest_ > 0 && event.kind == EventKind::OffsetWord && event.wordValue().lo > greatest_) {
      if (auto finding = ctx.report(*event.word))
        finding.severity(Severity::Error)
            .message("`{0}`: the control has {1} offsets and stops with an alarm",
                     ctx.text(*event.word), int(greatest_));
      return;
    }
    if (!ctx.machine().hasTools || !event.wordValue().isConstant() ||
        event.wordValue().value() < 0 || event.wordValue().value() > 1e8)
      return;
    const auto number = int(event.wordValue().value());
    const Word &word = *event.word;
    if (event.kind == EventKind::OffsetWord) {
      if (ofTools_ && !isOffset(word, ctx))
        return;
      check(word, number, ofTools_ ? "tool" : "offset", ctx);
      return;
    }
    if (!ctx.dialect().isLathe()) {
      check(word, number, "tool", ctx);
      return;
    }
    if (number < 100) // which of the two it names differs
      return;
    if (!check(word, number / 100, "tool", ctx))
      check(word, number % 100, "offset", ctx);
  }

private:
  /// Whether a code of the block takes the word for an offset.
  static bool isOffset(const Word &word, RuleContext &ctx) {
    return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      return llvm::any_of(ctx.code(use).words, [&](const WordSpec &spec) {
        return spec.role == Role::Offset && (spec.any & maskOf(word.address));
      });
    });
  }

  /// Number 0 is never stored and always means zero.
  static bool check(const Word &word, int number, const char *what, RuleContext &ctx) {
    if (number == 0 || ctx.machine().tools.count(number))
      return false;
    if (auto finding = ctx.report(word))
      finding.message("`{0}`: {1} {2} is not in the tool list", ctx.text(word), what, number);
    return true;
  }

  double greatest_ = 0;  ///< number of the last offset; 0: not known
  bool ofTools_ = false; ///< the number of an offset is that of a tool
};

} // namespace
NCVET_RULE(ToolNotInList, tool_not_in_list)
} // namespace ncvet
