// Evaluates expressions of the program on abstract values.
#include "interp/evaluate/expression.h"

#include "interp/evaluate/program_operators.h"
#include "interp/state/event.h"
#include "interp/state/zero_point.h"
#include "interp/value/units.h"

#include <algorithm>
#include <cmath>

namespace ncvet {

namespace {
/// A variable may be written with any number of digits; no control has so many.
constexpr double pastNumbers = 0x1p63;

/// Extended common variables of larger controls.
constexpr int64_t firstExtended = 98000, lastExtended = 98499;

bool isCommon(const MachineState &state, int64_t number) {
  return (number > state.ranges.lastLocal && number <= state.ranges.lastCommon) ||
         (number >= firstExtended && number <= lastExtended) ||
         number >= int64_t(firstSharedVariable);
}

/// Numbered local variables, and the names that the running program has defined.
bool isLocal(const MachineState &state, int64_t number) {
  return (number > 0 && number <= state.ranges.lastLocal) ||
         (number >= int64_t(firstNamedVariable) &&
          (state.ranges.namedLocal || state.locals.given(uint64_t(number)) != Truth::No));
}

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

/// A coordinate, as the program would write it.
Value asWritten(const MachineState &state, size_t axis, const Interval &place) {
  if (!place.isConstant())
    return Value::unknown();
  const bool isLength = Axis(axis) < Axis::A || Axis(axis) > Axis::C;
  const uint64_t set = state.ranges.units == noGroup ? groupUnset : state.group(state.ranges.units);
  if (!isLength || !(set & state.ranges.inch))
    return Value::of(place.value());
  return set & ~state.ranges.inch ? Value::unknown()
                                  : Value::of(place.value() / millimetresPerInch);
}

/// Coordinate of the tool.
Value coordinateOf(const MachineState &state, size_t axis) {
  return state.machineAxes >> axis & 1 ? Value::unknown()
                                       : asWritten(state, axis, state.position[axis]);
}

/// Coordinate of the tool on the machine.
Value placeOnMachine(const MachineState &state, size_t axis) {
  if (state.machineAxes >> axis & 1)
    return asWritten(state, axis, state.position[axis]);
  Place place = state.position;
  for (size_t i = 0; i < axisCount; ++i)
    if (state.machineAxes >> i & 1)
      place[i] = Interval::unknown();
  return asWritten(state, axis, zeroOf(state.ranges.zeros, state).toMachine(place)[axis]);
}

/// Axis whose coordinate the variable holds; none when it holds something else.
std::optional<size_t> placeOf(const MachineState &state, int64_t number) {
  if (!state.ranges.place)
    return std::nullopt;
  if (const int64_t axis = number - state.ranges.place; axis >= 0 && axis < int64_t(axisCount))
    return size_t(axis);
  if (number < int64_t(firstSharedVariable))
    return std::nullopt;
  static const auto names = [] {
    std::array<int64_t, axisCount> keys{};
    for (size_t i = 0; i < axisCount; ++i)
      keys[i] = int64_t(sharedVariableKey(std::string("_") + "xyzabcuvw"[i]));
    return keys;
  }();
  const auto found = llvm::find(names, number);
  return found == names.end() ? std::nullopt : std::optional(size_t(found - names.begin()));
}

} // namespace

Value evaluate(const Block &block, uint16_t index, const MachineState &state, Outcome *outcome) {
  if (index >= block.expressions.size())
    return Value::unknown();
  const Expression &expression = block.expressions[index];
  if (expression.count == 1 && block.operations[expression.first].op == Op::Number)
    return Value::of(block.operations[expression.first].value);
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

namespace {
Value constantOf(const Interval &known) {
  return known.isConstant() ? Value::of(known.value()) : Value::unknown();
}

/// Value of a variable of the control that says what is in force; none: it is no such variable.
std::optional<Value> shownIn(const MachineState &state, uint64_t key) {
  if (!state.ranges.shown || state.commons.given(key) != Truth::No) // (the program wrote to it)
    return std::nullopt;
  const auto byKey = [](const ShownVariable &a, uint64_t b) { return a.key < b; };
  std::optional<Value> shown;
  for (auto at =
           std::lower_bound(state.ranges.shown->begin(), state.ranges.shown->end(), key, byKey);
       at != state.ranges.shown->end() && at->key == key; ++at) {
    shown = shown ? shown : Value::unknown();
    switch (at->part) {
    case ShownVariable::Part::Tool:
      return state.tool >= 0 ? Value::of(double(state.tool.get())) : Value::unknown();
    case ShownVariable::Part::Feed: // (in another unit it is another number)
      return state.must(Fact::FeedSet) && !state.may(Fact::FeedCarried) ? constantOf(state.feed)
                                                                        : Value::unknown();
    case ShownVariable::Part::Speed:
      return state.must(Fact::SpeedSet) ? constantOf(state.speed) : Value::unknown();
    case ShownVariable::Part::PlaceOnMachine:
      return placeOnMachine(state, size_t(at->value));
    case ShownVariable::Part::Code:
      if (at->group != noGroup && state.group(at->group) == at->member)
        shown = Value::of(at->value);
    }
  }
  return shown;
}
} // namespace

Value readVariable(const MachineState &state, int64_t number) {
  if (number == 0)
    return Value::vacant();
  if (const auto shown = shownIn(state, uint64_t(number)))
    return *shown;
  if (const auto axis = placeOf(state, number))
    return coordinateOf(state, *axis);
  if (isLocal(state, number))
    return state.locals.get(uint64_t(number));
  if (isCommon(state, number))
    return state.commons.get(uint64_t(number));
  return Value::unknown();
}

Truth isUnset(const MachineState &state, double number) {
  if (number < double(firstNamedVariable) || number >= pastNumbers)
    return Truth::No;
  const auto key = uint64_t(number);
  if (state.locals.given(key) != Truth::No)
    return Truth::No;
  return state.commons.given(key) == Truth::No ? Truth::Yes
         : state.commons.givenOnSomePaths(key) ? Truth::Unknown
                                               : Truth::No;
}

void emitUnsetRead(const MachineState &state, const ExpressionOp &op, Outcome &outcome) {
  const Truth unset = isUnset(state, op.value);
  if (unset == Truth::No)
    return;
  Event &event = outcome.emit(EventKind::UnsetRead);
  event.setPlace(op.offset);
  event.certain = unset == Truth::Yes;
}

void writeVariable(MachineState &state, int64_t number, const Value &value) {
  if (isLocal(state, number))
    state.locals.set(uint64_t(number), value);
  else if (isCommon(state, number))
    state.commons.set(uint64_t(number), value);
}

} // namespace ncvet
