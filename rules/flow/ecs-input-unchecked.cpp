// An answer of the operator that nothing checks.
#include "analyzer/facts/called_blocks.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/evaluate/expression.h"

#include "llvm/ADT/DenseSet.h"

namespace ncvet {
namespace {

class EcsInputUnchecked final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Statement); }

  void on(const Event &event, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    const Item &item = block.items[event.item()];
    if (item.kind != ItemKind::Input)
      return sleepAtBlock();
    const SourceRange range = ctx.range(item);
    const SourceRange name{ctx.source().id(), item.nameBegin, item.nameEnd};
    int64_t index = 0;
    llvm::StringRef variable = ctx.text(name).trim();
    if (!variable.consume_front_insensitive("R") || variable.getAsInteger(10, index)) {
      if (auto finding = ctx.report(name))
        finding.message("`{0}` takes no answer: the operator's value goes to a parameter, as R1",
                        ctx.text(name));
      return;
    }
    // The bounds follow the target and the prompt.
    const auto arguments = block.argumentsOf(item);
    if (!arguments.empty())
      escape(item, arguments[0], range, ctx);
    std::optional<double> bound[2];
    for (size_t i = 0; i < 2 && i + 2 < arguments.size(); ++i)
      if (arguments[i + 2].expression != noExpression) {
        const Value value = evaluate(block, arguments[i + 2].expression, ctx.before(), nullptr);
        if (value.isConstant())
          bound[i] = value.number.value();
        else
          return;
      }
    if (bound[0] && bound[1] && *bound[0] >= *bound[1]) {
      if (auto finding = ctx.report(range))
        finding.message(*bound[0] > *bound[1]
                            ? "no answer to `{0}` is allowed: the least value is greater than the "
                              "greatest"
                            : "`{0}` allows one answer only: the least value is the greatest",
                        ctx.text(range));
    } else if (!bound[0] && !bound[1] && moves(block.keyOf(item.target), ctx)) {
      if (auto finding = ctx.report(range))
        finding.severity(Severity::Style)
            .message(
                "`{0}` takes any answer: bounds keep a slip of the operator out of the program",
                ctx.text(range));
    }
  }

private:
  using Keys = llvm::SmallDenseSet<uint64_t, 8>;

  static bool reads(const Block &block, uint16_t expression, const Keys &keys) {
    if (expression == noExpression)
      return false;
    const Expression &each = block.expressions[expression];
    return llvm::any_of(llvm::makeArrayRef(block.operations).slice(each.first, each.count),
                        [&](const ExpressionOp &op) {
                          return op.op == Op::Variable && keys.contains(uint64_t(op.value));
                        });
  }

  /// A user's variable; others are words of cycles.
  static bool isParameter(llvm::StringRef name) {
    int64_t index = 0;
    return name.consume_front_insensitive("R") && !name.getAsInteger(10, index);
  }

  /// Whether the block moves by one of the variables; those that it sets by them are added.
  static bool uses(const Block &block, llvm::StringRef text, Keys &keys) {
    for (const Word &word : block.words)
      if (word.address != variableAddress && word.has(wordExpression) &&
          reads(block, uint16_t(word.mantissa), keys))
        return true;
    for (const Item &item : block.items) {
      if (item.kind != ItemKind::Assignment || !reads(block, item.value, keys))
        continue;
      if (!isParameter(text.slice(item.nameBegin, item.nameEnd).trim()))
        return true;
      keys.insert(block.keyOf(item.target));
    }
    return false;
  }

  /// Whether the value of the variable comes to a word of the program, as it is or by way of other
  /// variables. Programs that are called may use it too.
  static bool moves(uint64_t variable, RuleContext &ctx) {
    Keys keys;
    keys.insert(variable);
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (size_t known = 0; known != keys.size();) {
      known = keys.size();
      for (const Block &block : blocks(ctx.index(), program.body, program.end))
        if (uses(block, ctx.source().text(), keys) ||
            (entersProgram(block) && !eachCalledBlock(ctx.unit(), block, [&](const Block &called) {
               return !called.items.empty() ? false : !uses(called, "", keys);
             })))
          return true;
    }
    return false;
  }

  /// An operator who leaves the question gives no answer: the blocks after the target do without
  /// it.
  static void escape(const Item &item, const Argument &target, SourceRange range,
                     RuleContext &ctx) {
    const uint64_t key = ctx.block().keyOf(item.target);
    const auto to = blockNamed(ctx.index(), ctx.block(), item, target);
    if (!key || !to || ctx.before().commons.given(key) != Truth::No)
      return;
    constexpr unsigned readable = 20;
    const auto size = uint32_t(ctx.source().text().size());
    for (const Block &next : blocks(ctx.index(), *to, size, readable)) {
      for (const ExpressionOp &op : next.operations)
        if (op.op == Op::Variable && uint64_t(op.value) == key) {
          if (auto finding = ctx.report(range))
            finding
                .message(
                    "`{0}`: who leaves with ESC gives no value, and the target's blocks use it",
                    ctx.text(range))
                .note(ctx.range(next), "it is used here");
          return;
        }
      const bool leaves = llvm::any_of(next.items, [&](const Item &other) {
        return other.kind != ItemKind::Instruction &&
               (other.kind != ItemKind::Assignment || next.keyOf(other.target) == key);
      });
      if (leaves)
        return;
    }
  }
};

} // namespace
NCVET_RULE(EcsInputUnchecked, ecs_input_unchecked)
} // namespace ncvet
