// A condition has always the same result.
#include "analyzer/rule.h"
#include "interp/expression.h"

namespace ncvet {
namespace {

class FlowConstantCondition final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Block}); }

  void on(const Event &, RuleContext &ctx) override {
    const Block &block = ctx.block();
    for (const Item &item : block.items)
      if (item.kind == ItemKind::Jump && item.jump == JumpKind::BySign)
        choice(item, ctx);
      else if (item.kind == ItemKind::Structure && item.structure == Structure::For)
        empty(item, ctx);
      else if ((item.kind == ItemKind::If || item.kind == ItemKind::While ||
                (item.kind == ItemKind::Structure && item.structure != Structure::Until)) &&
               item.condition < block.expressions.size())
        check(block.expressions[item.condition], item, ctx);
  }

private:
  /// A choice by sign that always goes one way.
  static void choice(const Item &item, RuleContext &ctx) {
    const Block &block = ctx.block();
    const auto targets = block.argumentsOf(item);
    const SourceRange range{ctx.source().id(), item.begin, item.end};
    bool same = targets.size() == 3;
    for (const Argument &target : targets)
      same &= ctx.text(SourceRange{ctx.source().id(), target.begin, target.end}) ==
              ctx.text(SourceRange{ctx.source().id(), targets[0].begin, targets[0].end});
    if (same) {
      if (auto finding = ctx.report(range))
        finding.message("all three ways of `{0}` lead to the same block", ctx.text(range));
      return;
    }
    check(block.expressions[item.condition], item, ctx);
  }

  /// FOR counts upwards only.
  static void empty(const Item &item, RuleContext &ctx) {
    const Block &block = ctx.block();
    const auto constant = [&](uint16_t index) -> std::optional<double> {
      if (index >= block.expressions.size())
        return std::nullopt;
      const Expression &e = block.expressions[index];
      for (uint32_t i = 0; i < e.count; ++i)
        if (block.operations[e.first + i].op == Op::Variable)
          return std::nullopt;
      const Value value = evaluate(block, index, ctx.before(), nullptr);
      return value.isConstant() ? std::optional(value.number.value()) : std::nullopt;
    };
    const auto first = constant(item.value), last = constant(item.limit);
    if (!first || !last || *first <= *last)
      return;
    const SourceRange range{ctx.source().id(), item.begin, item.end};
    if (auto finding = ctx.report(range))
      finding.message("`{0}` never runs: it counts upwards by one", ctx.text(range));
  }

  /// Only what no variable decides: a parameter that is set at the program's head is there to be
  /// changed. `WHILE [1 EQ 1]` is the usual way to write a loop that is left by a jump.
  static void check(const Expression &condition, const Item &item, RuleContext &ctx) {
    if (condition.bad || condition.count == 0)
      return;
    const auto operations =
        llvm::makeArrayRef(ctx.block().operations).slice(condition.first, condition.count);
    for (const ExpressionOp &op : operations)
      if (op.op == Op::Variable || op.op == Op::VariableAt || op.op == Op::ElementAt ||
          op.op == Op::Opaque || op.op == Op::Vacant || op.op == Op::Unknown)
        return;
    const Truth truth = truthOf(evaluate(ctx.block(), item.condition, ctx.before(), nullptr));
    if (truth == Truth::Unknown ||
        ((item.kind == ItemKind::While || item.structure == Structure::While) &&
         truth == Truth::Yes))
      return;
    const SourceRange range{ctx.source().id(), condition.begin, condition.end};
    if (auto finding = ctx.report(range))
      finding.message("this condition is always {0}: no variable stands in it",
                      truth == Truth::Yes ? "true" : "false");
  }
};

} // namespace
NCVET_RULE(FlowConstantCondition, flow_constant_condition)
} // namespace ncvet
