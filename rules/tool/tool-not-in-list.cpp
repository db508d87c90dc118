// Tool and offset numbers that the machine profile's list does not have.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class ToolNotInList final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::ToolWord);
    if (!to.dialect().offsetsOfTool)
      to.on(EventKind::OffsetWord);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (!ctx.machine().hasTools || !event.wordValue().isConstant() ||
        event.wordValue().value() < 0 || event.wordValue().value() > 1e8)
      return;
    const auto number = int(event.wordValue().value());
    const Word &word = *event.word;
    if (event.kind == EventKind::OffsetWord) {
      check(word, number, "offset", ctx);
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
  /// Number 0 is never stored and always means zero.
  static bool check(const Word &word, int number, const char *what, RuleContext &ctx) {
    if (number == 0 || ctx.machine().tools.count(number))
      return false;
    if (auto finding = ctx.report(word))
      finding.message("`{0}`: {1} {2} is not in the tool list", ctx.text(word), what, number);
    return true;
  }
};

} // namespace
NCVET_RULE(ToolNotInList, tool_not_in_list)
} // namespace ncvet
