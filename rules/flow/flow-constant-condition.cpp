// A condition has always the same result.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/expression.h"
#include "interp/evaluate/variable_access.h"

#include <array>
#include <map>

namespace ncvet {
namespace {

struct FlowConstantConditionMemory {
  struct Choice {
    SourceRange range;
    unsigned ways = 0; ///< bit per way that was possible: below zero, zero, above zero
    bool known = true; ///< the value was one number every time
  };
  /// A condition that the block before it decides.
  struct Decided {
    SourceRange range, variable;
    int64_t number = -1; ///< of its block
    bool truth = false;
    bool other = false; ///< it was reached with another result too
    bool loops = false; ///< it is that of a loop, which has to begin as true
  };
  /// A loop whose condition compares two values.
  struct Loop {
    SourceRange range;
    bool mayRun = false;
  };
  std::map<std::pair<FileId, uint32_t>, Loop> loops;
  std::map<std::pair<FileId, uint32_t>, Choice> choices;
  std::map<std::pair<FileId, uint32_t>, Decided> decided;
};

class FlowConstantCondition final : public StatefulRule<FlowConstantConditionMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Block});
    onlyLoops_ = to.flag("onlyLoops");
  }

  void on(const Event &, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    if (block.items.empty())
      return sleepInShape();
    sleepAtBlock(); // unless it reads a variable
    for (const Item &item : block.items)
      if (onlyLoops_) {
        if (isLoop(item))
          neverRuns(item, ctx);
      } else if (item.kind == ItemKind::Jump && item.jump == JumpKind::BySign)
        choice(item, ctx);
      else if (item.kind == ItemKind::Structure && item.structure == Structure::For)
        empty(item, ctx);
      else if ((item.kind == ItemKind::If || item.kind == ItemKind::While ||
                (item.kind == ItemKind::Structure && item.structure != Structure::Until)) &&
               item.condition < block.expressions.size())
        check(block.expressions[item.condition], item, ctx);
  }

  void finish(const FileSummary &file, RuleContext &ctx) const override {
    if (!file.complete)
      return;
    for (const auto &[place, set] : memory().decided) {
      // A jump to the block brings other values along.
      if (place.first != file.source.id() || set.other || (set.loops && set.truth) ||
          std::binary_search(file.usedNumbers.begin(), file.usedNumbers.end(), set.number))
        continue;
      if (auto finding = ctx.report(set.range))
        finding
            .message("this condition is always {0}: `{1}` in the block before decides it",
                     set.truth ? "true" : "false", ctx.text(set.variable))
            .note(set.variable, "the value is given here");
    }
    for (const auto &[place, loop] : memory().loops) {
      if (place.first != file.source.id() || loop.mayRun || memory().decided.count(place))
        continue;
      if (auto finding = ctx.report(loop.range))
        finding.message(
            "this loop never runs: its condition is false each time that it is reached");
    }
    if (onlyLoops_)
      return;
    for (const auto &[place, choice] : memory().choices) {
      if (place.first != file.source.id() || !choice.known ||
          (choice.ways != 1 && choice.ways != 2 && choice.ways != 4))
        continue;
      if (auto finding = ctx.report(choice.range))
        finding.severity(Severity::Style)
            .message("`{0}` takes one branch only: the value that it tests is {1} whenever it is "
                     "reached",
                     ctx.text(choice.range),
                     choice.ways == 1   ? "below zero"
                     : choice.ways == 2 ? "zero"
                                        : "above zero");
    }
  }

private:
  bool onlyLoops_ = false; ///< conditions of loops are all that is looked at

  static bool isLoop(const Item &item) {
    return item.kind == ItemKind::While ||
           (item.kind == ItemKind::Structure && item.structure == Structure::While);
  }

  /// A loop that compares two values, none of which is the other: `#1 GT 6` where `#1 LT 6` was
  /// meant, or a counter that another loop has used up. Two that are the same are a loop that is
  /// run no times on purpose.
  void neverRuns(const Item &item, RuleContext &ctx) const {
    const Block &block = ctx.block();
    if (item.condition >= block.expressions.size())
      return;
    const Expression &e = block.expressions[item.condition];
    if (e.bad || e.count != 3 || block.skip >= 0)
      return;
    const auto operations = llvm::makeArrayRef(block.operations).slice(e.first, e.count);
    std::array<Value, 2> sides;
    for (size_t i = 0; i < 2; ++i)
      if (operations[i].op == Op::Variable)
        sides[i] = readVariable(ctx.before(), int64_t(operations[i].value));
      else if (operations[i].op == Op::Number)
        sides[i] = Value::of(operations[i].value);
      else
        return;
    if (operations[0].op != Op::Variable)
      return;
    Memory::Loop &loop = memory().loops[{ctx.source().id(), e.begin}];
    loop.range = ctx.range(e);
    loop.mayRun |= !sides[0].isConstant() || !sides[1].isConstant() ||
                   sides[0].number.value() == sides[1].number.value() ||
                   truthOf(evaluate(block, item.condition, ctx.before(), nullptr)) != Truth::No;
  }

  /// Remembers where a choice by sign can go.
  void noteChoice(const Item &item, SourceRange range, RuleContext &ctx) const {
    Memory::Choice &choice = memory().choices[{ctx.source().id(), item.begin}];
    choice.range = range;
    const Value value = evaluate(ctx.block(), item.condition, ctx.before(), nullptr);
    choice.known &= value.isConstant() && ctx.callDepth() == 0;
    const Interval number = value.asNumber();
    choice.ways |=
        (number.lo < 0 ? 1u : 0u) | (number.contains(0) ? 2u : 0u) | (number.hi > 0 ? 4u : 0u);
  }

  /// A choice by sign that always takes one branch.
  void choice(const Item &item, RuleContext &ctx) const {
    const Block &block = ctx.block();
    const auto targets = block.argumentsOf(item);
    const SourceRange range = ctx.range(item);
    bool same = targets.size() == 3;
    for (const Argument &target : targets)
      same &= ctx.text(ctx.range(target)) ==
              ctx.text(SourceRange{ctx.source().id(), targets[0].begin, targets[0].end});
    if (same) {
      if (auto finding = ctx.report(range))
        finding.message("all three ways of `{0}` lead to the same block", ctx.text(range));
      return;
    }
    if (item.condition < block.expressions.size() && !block.expressions[item.condition].bad)
      noteChoice(item, range, ctx);
  }

  /// FOR counts upwards only.
  static void empty(const Item &item, RuleContext &ctx) {
    const Block &block = ctx.block();
    const auto constant = [&](uint16_t index) -> std::optional<double> {
      if (index >= block.expressions.size())
        return std::nullopt;
      const Expression &e = block.expressions[index];
      for (uint32_t i = 0; i < e.count; ++i)
        if (block.operations[e.first + i].op == Op::Variable &&
            !isGivenBefore(uint64_t(block.operations[e.first + i].value), ctx))
          return std::nullopt;
      const Value value = evaluate(block, index, ctx.before(), nullptr);
      return value.isConstant() ? std::optional(value.number.value()) : std::nullopt;
    };
    const auto first = constant(item.value), last = constant(item.limit);
    if (!first || !last || *first <= *last)
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` never runs: it counts upwards by one", ctx.text(range));
  }

  /// `R1=5` and then `IF R1>3`: nothing can have changed the value in between.
  void byBlockBefore(const Expression &condition, llvm::ArrayRef<ExpressionOp> operations,
                     const Item &item, RuleContext &ctx) const {
    uint64_t key = 0;
    for (const ExpressionOp &op : operations) {
      if (op.op == Op::VariableAt || op.op == Op::ElementAt || op.op == Op::Opaque ||
          op.op == Op::Vacant || op.op == Op::Unknown)
        return;
      if (op.op != Op::Variable)
        continue;
      if (key && key != uint64_t(op.value))
        return;
      key = uint64_t(op.value);
    }
    Block before;
    if (!key || ctx.block().hasLabel() || ctx.block().skip >= 0 || !readPrevious(ctx, before) ||
        before.skip >= 0)
      return;
    const Item *given = nullptr;
    for (const Item &other : before.items) {
      if (other.kind != ItemKind::Assignment)
        return; // a jump, a call: another path leads here
      if (before.keyOf(other.target) == key)
        given = &other;
    }
    if (!given || given->value >= before.expressions.size())
      return;
    // A value that is worked out, or read, is there to be looked at.
    const Expression &value = before.expressions[given->value];
    for (uint32_t i = 0; i < value.count; ++i)
      if (const Op op = before.operations[value.first + i].op; op != Op::Number && op != Op::Negate)
        return;
    if (isChoice(key, ctx))
      return;
    const Truth truth = truthOf(evaluate(ctx.block(), item.condition, ctx.before(), nullptr));
    if (truth == Truth::No && refuses(item, ctx))
      return;
    Memory::Decided &decided = memory().decided[{ctx.source().id(), condition.begin}];
    decided.other |=
        truth == Truth::Unknown || (decided.range.end && decided.truth != (truth == Truth::Yes));
    decided.range = ctx.range(condition);
    decided.variable = ctx.range(*given);
    decided.number = numberAfter(before, ctx);
    decided.truth = truth == Truth::Yes;
    decided.loops = item.kind == ItemKind::Structure && item.structure == Structure::While;
  }

  /// The condition leads to an alarm: it watches over a number that who sets up the machine edits.
  static bool refuses(const Item &condition, const RuleContext &ctx) {
    const Block &here = ctx.block();
    const auto index = size_t(&condition - here.items.data());
    if (index + 1 >= here.items.size() || here.items[index + 1].kind != ItemKind::Jump)
      return false;
    const Value to = evaluate(here, here.items[index + 1].value, ctx.before(), nullptr);
    if (!to.isConstant())
      return false;
    const auto place = resolveBlock(ctx.index(), ctx.index().programAt(here.begin),
                                    Reference::toBlock(int64_t(to.number.value())), here.begin);
    if (!place)
      return false;
    const auto &alarms = ctx.dialect().facts->messages.variables;
    constexpr unsigned furthest = 3; // blocks
    for (const Block &block :
         blocks(ctx.index().reader(), *place, ctx.index().programAt(here.begin).end, furthest))
      for (const Item &item : block.items)
        if (item.kind == ItemKind::Assignment && llvm::any_of(alarms, [&](const auto variable) {
              return block.keyOf(item.target) == uint64_t(variable);
            }))
          return true;
    return false;
  }

  /// The number by which a jump comes between the two blocks, to an empty block or to this one.
  static int64_t numberAfter(const Block &before, const RuleContext &ctx) {
    for (const Block &block : blocks(ctx.index().reader(), before.next, ctx.block().begin))
      if (block.number >= 0)
        return block.number;
    return ctx.block().number;
  }

  /// A further condition of the next blocks asks for the same variable: its value chooses one part
  /// of a family, and whoever sets up the machine changes it.
  static bool isChoice(uint64_t variable, const RuleContext &ctx) {
    constexpr unsigned furthest = 40; // blocks
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &next :
         blocks(ctx.index().reader(), ctx.block().next, program.end, furthest)) {
      for (const Item &item : next.items) {
        if (item.kind == ItemKind::Assignment && next.keyOf(item.target) == variable)
          return false;
        if (item.kind == ItemKind::If && item.condition < next.expressions.size() &&
            names(next, next.expressions[item.condition], variable))
          return true;
      }
    }
    return false;
  }
  static bool names(const Block &block, const Expression &expression, uint64_t variable) {
    const auto operations =
        llvm::makeArrayRef(block.operations).slice(expression.first, expression.count);
    return llvm::any_of(operations, [&](const ExpressionOp &op) {
      return op.op == Op::Variable && uint64_t(op.value) == variable;
    });
  }

  /// The block before gives the variable a number.
  static bool isGivenBefore(uint64_t variable, const RuleContext &ctx) {
    Block before;
    if (ctx.block().hasLabel() || ctx.block().skip >= 0 || !readPrevious(ctx, before) ||
        before.skip >= 0)
      return false;
    return llvm::any_of(before.items, [&](const Item &item) {
      return item.kind == ItemKind::Assignment && before.keyOf(item.target) == variable &&
             before.numberIn(item.value);
    });
  }

  /// Only what no variable decides: a parameter that is set at the program's head is there to be
  /// changed. `WHILE [1 EQ 1]` is the usual way to write a loop that is left by a jump.
  void check(const Expression &condition, const Item &item, RuleContext &ctx) const {
    if (condition.bad || condition.count == 0)
      return;
    if (isLoop(item))
      neverRuns(item, ctx);
    const auto operations =
        llvm::makeArrayRef(ctx.block().operations).slice(condition.first, condition.count);
    if (item.kind == ItemKind::If ||
        (item.kind == ItemKind::Structure &&
         (item.structure == Structure::If || item.structure == Structure::While)))
      byBlockBefore(condition, operations, item, ctx);
    for (const ExpressionOp &op : operations)
      if (op.op == Op::Variable || op.op == Op::VariableAt || op.op == Op::ElementAt ||
          op.op == Op::Opaque || op.op == Op::Vacant || op.op == Op::Unknown)
        return;
    const Truth truth = truthOf(evaluate(ctx.block(), item.condition, ctx.before(), nullptr));
    if (truth == Truth::Unknown ||
        ((item.kind == ItemKind::While || item.structure == Structure::While) &&
         truth == Truth::Yes))
      return;
    const SourceRange range = ctx.range(condition);
    if (auto finding = ctx.report(range))
      finding.message("this condition is always {0}: it has no variable",
                      truth == Truth::Yes ? "true" : "false");
  }
};

} // namespace
NCVET_RULE(FlowConstantCondition, flow_constant_condition)
} // namespace ncvet
