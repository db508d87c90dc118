// A text where a number is due, or a number where a text is.
#include "analyzer/rule.h"
#include "interp/expression.h"

#include <cmath>

namespace ncvet {
namespace {

class VariableTypeMismatch final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on({EventKind::Statement, EventKind::ToolWord}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::ToolWord)
      return cutOff(*event.word, ctx);
    const Block &block = ctx.block();
    const Item &item = block.items[size_t(event.number)];
    if ((item.kind != ItemKind::Assignment && item.kind != ItemKind::Definition) ||
        item.value == noExpression || (item.kind == ItemKind::Definition && item.arguments))
      return;
    const SourceRange name{ctx.source().id(), item.nameBegin, item.nameEnd};
    VariableType type = item.type;
    if (item.kind == ItemKind::Assignment)
      type = typeOf(ctx.text(name), ctx);
    const Expression &value = block.expressions[item.value];
    const SourceRange range{ctx.source().id(), value.begin, value.end};
    const bool text = !value.bad && value.count == 1 && ctx.text(range).startswith("\"");
    const bool number = !value.bad && value.count == 1 &&
                        block.operations[value.first].op == Op::Number &&
                        ctx.dialect().lexical.commaSeparates && !ctx.text(range).startswith("\"");
    const bool takesNumber = type == VariableType::Integer || type == VariableType::Real ||
                             type == VariableType::Boolean;
    const bool takesText = type == VariableType::String || type == VariableType::Axis;
    if (!(text && takesNumber) && !(number && takesText))
      return;
    if (auto finding = ctx.report(range))
      finding.message(text ? "`{0}` is a text, and `{1}` holds numbers"
                           : "`{0}` is a number, and `{1}` holds none",
                      ctx.text(range), ctx.text(name));
  }

private:
  /// `T<FTL(R12)>` with 14.6 in R12 is another tool.
  static void cutOff(const Word &word, RuleContext &ctx) {
    const Block &block = ctx.block();
    if (!word.has(wordExpression) || size_t(word.mantissa) >= block.expressions.size())
      return;
    const Expression &e = block.expressions[size_t(word.mantissa)];
    if (e.bad || e.count != 2 || block.operations[e.first].op != Op::Variable ||
        block.operations[e.first + 1].op != Op::Truncate)
      return;
    const Value value = readVariable(ctx.after(), int64_t(block.operations[e.first].value));
    if (!value.isConstant() || value.number.value() == std::floor(value.number.value()))
      return;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning)
          .message("`{0}` cuts a fraction off: the value is {1}", ctx.text(word),
                   llvm::formatv("{0}", llvm::format("%g", value.number.value())).str());
  }

  static VariableType typeOf(llvm::StringRef name, RuleContext &ctx) {
    name = name.split('[').first.trim();
    int64_t index = 0;
    if ((name.startswith("R") || name.startswith("r")) &&
        !name.drop_front().getAsInteger(10, index))
      return VariableType::Real;
    const Defined *defined = ctx.index().definition(ctx.index().programAt(ctx.block().begin), name);
    return defined && defined->kind == ItemKind::Definition ? defined->type : VariableType::None;
  }
};

} // namespace
NCVET_RULE(VariableTypeMismatch, variable_type_mismatch)
} // namespace ncvet
