// A fraction is compared for equality.
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/evaluate/expression.h"

#include <cmath>

namespace ncvet {
namespace {

class VariableFloatEquality final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::Statement);
    constants_ = to.flag("constants", true);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    sleepAtBlock();
    const Block &block = ctx.block();
    const Item &item = block.items[event.item()];
    if (item.kind == ItemKind::Jump && item.jump == JumpKind::BySign)
      return choice(item, ctx);
    if (item.condition == noExpression || item.kind == ItemKind::Jump)
      return;
    const Expression &condition = block.expressions[item.condition];
    const auto operations = operationsOf(block, condition);
    bool variable = false;
    for (size_t i = 0; i < operations.size(); ++i) {
      variable |= operations[i].op == Op::Variable || operations[i].op == Op::ElementAt;
      // A number right before its comparison.
      const bool equal =
          i > 0 && (operations[i].op == Op::Equal || operations[i].op == Op::NotEqual);
      if (!equal || operations[i - 1].op != Op::Number || !variable ||
          operations[i - 1].value == std::floor(operations[i - 1].value) ||
          !(constants_ || readsComputed(operations, ctx)))
        continue;
      if (holdsPlainNumbers(operations, ctx))
        return;
      const SourceRange range = ctx.range(condition);
      if (auto finding = ctx.report(range))
        finding.message(
            "`{0}` compares a fraction for equality: a value that was computed may miss "
            "it by its last digit",
            ctx.text(range));
      return;
    }
  }

private:
  /// Whether one of the variables was computed with a fraction or a quotient.
  static bool readsComputed(llvm::ArrayRef<ExpressionOp> operations, RuleContext &ctx) {
    return llvm::any_of(operations, [&](const ExpressionOp &op) {
      return op.op == Op::Divide ||
             (op.op == Op::Variable && comesFromFraction(uint64_t(op.value), ctx));
    });
  }

  /// The program gives the one variable of a condition nothing but numbers as they are written: it
  /// is a flag.
  static bool holdsPlainNumbers(llvm::ArrayRef<ExpressionOp> operations, RuleContext &ctx) {
    uint64_t variable = 0;
    for (const ExpressionOp &op : operations) {
      if (op.op == Op::ElementAt || (op.op == Op::Variable && variable))
        return false;
      if (op.op == Op::Variable)
        variable = uint64_t(op.value);
    }
    bool given = false;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block : blocks(ctx.index(), program.body, program.end))
      for (const Item &item : block.items) {
        if (item.kind == ItemKind::Call)
          return false; // a called program may compute it
        if (item.kind != ItemKind::Assignment || block.keyOf(item.target) != variable)
          continue;
        if (!block.numberIn(item.value))
          return false;
        given = true;
      }
    return given;
  }

  /// The middle branch of a choice by sign is one for equality.
  static void choice(const Item &item, RuleContext &ctx) {
    const Block &block = ctx.block();
    const auto targets = block.argumentsOf(item);
    if (item.condition >= block.expressions.size() || targets.size() != 3)
      return;
    const auto textOf = [&](const Argument &target) { return ctx.text(ctx.range(target)); };
    if (textOf(targets[1]) == textOf(targets[0]) || textOf(targets[1]) == textOf(targets[2]))
      return;
    const Expression &condition = block.expressions[item.condition];
    bool variable = false, fraction = false;
    for (const ExpressionOp &op : operationsOf(block, condition)) {
      if (op.op == Op::Round || op.op == Op::Truncate)
        return;
      variable |= op.op == Op::Variable || op.op == Op::ElementAt;
      fraction |= op.op == Op::Number && op.value != std::floor(op.value);
      fraction |= op.op == Op::Variable && comesFromFraction(uint64_t(op.value), ctx);
    }
    if (!variable || !fraction)
      return;
    const SourceRange range = ctx.range(condition);
    if (auto finding = ctx.report(range))
      finding.message(
          "`{0}` may miss zero by its last digit: the branch for zero, `{1}`, is not taken then",
          ctx.text(range), textOf(targets[1]));
  }

  /// Computed with a fraction or a quotient, and not rounded.
  static bool isFraction(const Block &block, const Expression &e) {
    if (e.bad || e.count < 2)
      return false;
    const auto operations = operationsOf(block, e);
    const Op last = operations.back().op;
    return last != Op::Round && last != Op::Truncate &&
           llvm::any_of(operations, [](const ExpressionOp &op) {
             return op.op == Op::Divide ||
                    (op.op == Op::Number && op.value != std::floor(op.value));
           });
  }

  /// Whether the last assignment before the block computes the variable so.
  static bool comesFromFraction(uint64_t variable, RuleContext &ctx) {
    bool fraction = false;
    for (const Block &block :
         blocks(ctx.index(), ctx.index().programAt(ctx.block().begin).body, ctx.block().begin)) {
      for (const Item &item : block.items)
        if (item.kind == ItemKind::Assignment && block.keyOf(item.target) == variable &&
            item.value != noExpression)
          fraction = isFraction(block, block.expressions[item.value]);
    }
    return fraction;
  }

  bool constants_ = true; ///< a variable that the control or the operator sets may miss the value
};

} // namespace
NCVET_RULE(VariableFloatEquality, variable_float_equality)
} // namespace ncvet
