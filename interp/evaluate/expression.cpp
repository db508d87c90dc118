// Evaluates expressions of the program on abstract values.
#include "interp/evaluate/expression.h"

#include "interp/evaluate/known_number.h"
#include "interp/evaluate/program_operators.h"
#include "interp/state/event.h"
#include "interp/state/state.h"

#include <cmath>

namespace ncvet {

namespace {
/// The operands of programs: numbers and variables.
class ExpressionEvaluator {
public:
  ExpressionEvaluator(const Block &block, const MachineState &state, Outcome *outcome)
      : block_(block), state_(state), outcome_(outcome) {}

  Value run(const Expression &expression) {
    operate(expression);
    return stack_.result();
  }
  /// What the operation after these takes.
  Value last(const Expression &expression) {
    operate(expression);
    return stack_.pop();
  }

private:
  void operate(const Expression &expression) {
    for (const ExpressionOp &op : operationsOf(block_, expression)) {
      const std::optional<Operator> known = programOperators[size_t(op.op)];
      if (!known)
        operand(op);
      else if (!stack_.apply(*known) && outcome_)
        outcome_->emit(EventKind::DomainError).setPlace(op.offset);
    }
  }
  void operand(const ExpressionOp &op);

  const Block &block_;
  const MachineState &state_;
  Outcome *outcome_;
  OperatorStack stack_{OperatorRules()};
};

void ExpressionEvaluator::operand(const ExpressionOp &op) {
  switch (op.op) {
  case Op::Number:
    return stack_.push(Value::of(op.value));
  case Op::Vacant:
    return stack_.push(Value::vacant());
  case Op::Variable:
    if (outcome_)
      emitUnsetRead(state_, op, *outcome_);
    return stack_.push(op.value < pastNumbers ? readVariable(state_, int64_t(op.value))
                                              : Value::unknown());
  case Op::ElementAt:
  case Op::ElementKey: {
    const Value index = stack_.pop();
    if (!index.isConstant())
      return stack_.push(Value::unknown());
    const uint64_t key = elementKey(uint64_t(op.value), std::llround(index.number.value()));
    return stack_.push(op.op == Op::ElementKey ? Value::of(double(key))
                                               : readVariable(state_, int64_t(key)));
  }
  case Op::Opaque:
    for (unsigned i = 0; i < unsigned(op.value); ++i)
      stack_.pop();
    return stack_.push(Value::unknown());
  case Op::VariableAt: {
    const Value number = stack_.pop();
    const Interval n = number.asNumber();
    const bool known =
        number.kind != Value::Kind::Unknown && n.isConstant() && std::fabs(n.value()) <= 1e15;
    return stack_.push(known ? readVariable(state_, std::llround(n.value())) : Value::unknown());
  }
  case Op::Exists: {
    // Given a value on some path at least; one that all programs share may have it from elsewhere.
    const auto key = uint64_t(op.value);
    const bool local = key >= firstNamedVariable;
    const Truth given = local ? state_.locals.given(key) : state_.commons.given(key);
    return stack_.push(Value::of(numberOf(given == Truth::No && !local ? Truth::Unknown : given)));
  }
  default:
    // BIN, BCD, ADP and what the reader could not resolve.
    if (op.op != Op::Unknown)
      stack_.pop();
    return stack_.push(Value::unknown());
  }
}

} // namespace

Value evaluate(const Block &block, uint16_t index, const MachineState &state, Outcome *outcome) {
  if (index >= block.expressions.size())
    return Value::unknown();
  const Expression &expression = block.expressions[index];
  if (expression.count == 1 && block.operations[expression.first].op == Op::Number)
    return Value::of(block.operations[expression.first].value);
  if (const std::optional<double> number = knownNumber(block, index, state))
    return {Value::Kind::Number, {*number, *number}};
  return ExpressionEvaluator(block, state, outcome).run(expression);
}

Value operandOf(const Block &block, const Expression &expression, uint32_t place,
                const MachineState &state) {
  Expression before = expression;
  before.count = place;
  return ExpressionEvaluator(block, state, nullptr).last(before);
}

namespace {
/// Whether the item gives a variable a value that what is at `offset` finds.
bool assignsBefore(const Item &item, uint32_t offset) {
  return item.kind == ItemKind::Assignment && item.begin < offset && item.value != noExpression;
}

/// Whether an expression may read a variable that the block assigns before it.
bool readsAssigned(const Block &block, uint16_t index) {
  const Expression &expression = block.expressions[index];
  const auto reads = [&](const Item &item) {
    const uint64_t key = block.keyOf(item.target);
    return llvm::any_of(operationsOf(block, expression), [&](const ExpressionOp &op) {
      switch (op.op) {
      case Op::Variable:
        return !key || uint64_t(op.value) == key;
      case Op::VariableAt:
      case Op::ElementAt:
        return true;
      default:
        return false;
      }
    });
  };
  return llvm::any_of(block.items, [&](const Item &item) {
    return item.value != index && assignsBefore(item, expression.begin) && reads(item);
  });
}
} // namespace

Value evaluateInBlock(const Block &block, uint16_t index, const MachineState &before) {
  const bool conditional =
      llvm::any_of(block.items, [](const Item &item) { return item.kind == ItemKind::If; });
  // Where names belong to the running program the control assigns after the block's words.
  if (index >= block.expressions.size() || block.items.empty() || conditional ||
      before.ranges.namedLocal || !readsAssigned(block, index))
    return evaluate(block, index, before, nullptr);
  MachineState state = before;
  for (const Item &item : block.items)
    if (item.value != index && assignsBefore(item, block.expressions[index].begin))
      if (const Value key = evaluate(block, item.target, state, nullptr); key.isConstant())
        writeVariable(state, std::llround(key.number.value()),
                      evaluate(block, item.value, state, nullptr));
  return evaluate(block, index, state, nullptr);
}

Interval assignedWordValue(const Word &word, const Block &block, const MachineState &state) {
  if (word.has(wordNoValue))
    return Interval::unknown();
  if (!word.has(wordExpression))
    return Interval::exactly(word.value());
  const Value value = evaluate(block, uint16_t(word.mantissa), state, nullptr);
  return value.kind == Value::Kind::Number ? value.number : Interval::unknown();
}

Truth truthOf(const Value &value) {
  return value.kind == Value::Kind::Unknown ? Truth::Unknown : truthOf(value.asNumber());
}

void emitUnsetRead(const MachineState &state, const ExpressionOp &op, Outcome &outcome) {
  const Truth unset = isUnset(state, op.value);
  if (unset == Truth::No)
    return;
  Event &event = outcome.emit(EventKind::UnsetRead);
  event.setPlace(op.offset);
  event.certain = unset == Truth::Yes;
}

} // namespace ncvet
