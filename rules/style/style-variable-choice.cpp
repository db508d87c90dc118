// A variable that the control itself uses, or loses.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class StyleVariableChoice final : public Rule {
public:
  void listen(Subscriptions &to) override {
    from_ = int64_t(to.dialect().facts->variables.volatileFrom);
    if (from_)
      to.on({EventKind::Statement, EventKind::UnsetRead});
    if (to.flag("equalsSign"))
      to.onCode([](const CodeInfo &code) { return code.letter == 'M'; });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return constantAfterEquals(event, ctx);
    if (event.kind == EventKind::UnsetRead)
      return event.certain ? systemVariable(event, ctx) : void();
    const Item &item = ctx.block().items[event.item()];
    if (item.kind != ItemKind::Assignment)
      return;
    const SourceRange range{ctx.source().id(), item.nameBegin, item.nameEnd};
    llvm::StringRef name = ctx.text(range).trim();
    if (name.startswith("#")) {
      if (auto finding = ctx.report(range))
        finding.message("`{0}` is written by its number: the name of the variable says what it is",
                        name);
      return;
    }
    int64_t index = 0;
    if (!name.consume_front_insensitive("R") || name.getAsInteger(10, index) || index < from_ ||
        !goesOn(item, ctx))
      return;
    if (auto finding = ctx.report(range))
      finding.message("`R{0}` goes on from a value that is lost at power-off: R0 to R999 keep "
                      "theirs",
                      index);
  }

private:
  /// `M=8`: the form for what is computed.
  static void constantAfterEquals(const Event &event, RuleContext &ctx) {
    const llvm::StringRef text = event.word ? ctx.text(*event.word) : "";
    if (!event.word || !event.word->isNumber() || !text.drop_front().ltrim().startswith("="))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` is a constant in the form of what is computed: `M{1}` says the same",
                   text, event.word->codeNumber())
          .fix(FixSafety::Safe, "write the number after the letter",
               ctx.replace(ctx.range(*event.word), formatted("M{0}", event.word->value())));
  }

  /// `R1060=R1060+1` in a program that has not set R1060: it counts on from what was there before.
  static bool goesOn(const Item &item, const RuleContext &ctx) {
    const Block &block = ctx.block();
    const uint64_t key = block.keyOf(item.target);
    if (!key || item.value == noExpression || ctx.before().commons.given(key) != Truth::No)
      return false;
    const Expression &value = block.expressions[item.value];
    for (uint32_t i = 0; i < value.count; ++i) {
      const ExpressionOp &op = block.operations[value.first + i];
      if (op.op == Op::Variable && uint64_t(op.value) == key)
        return true;
    }
    return false;
  }

  static void systemVariable(const Event &event, RuleContext &ctx) {
    const auto begin = event.place();
    const llvm::StringRef text = ctx.source().text(begin, ctx.block().end);
    if (!text.startswith("#"))
      return;
    const size_t digits = text.drop_front().take_while(llvm::isDigit).size();
    const SourceRange range{ctx.source().id(), begin, uint32_t(begin + 1 + digits)};
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is read by its number: the name of the variable says what it is",
                      ctx.text(range));
  }

  int64_t from_ = 0; ///< parameters from here on do not keep their values
};

} // namespace
NCVET_RULE(StyleVariableChoice, style_variable_choice)
} // namespace ncvet
