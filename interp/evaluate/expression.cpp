// Evaluates expressions of the program on abstract values.
#include "interp/evaluate/expression.h"

#include "interp/value/units.h"

#include <algorithm>
#include <cmath>

namespace ncvet {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double degree = pi / 180;

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

Value fromTruth(Truth truth) {
  return truth == Truth::Unknown ? Value::of(Interval{0, 1}) : Value::of(truth == Truth::Yes);
}

Truth compare(Op op, const Value &a, const Value &b) {
  // A vacant value equals only another vacant one under EQ and NE; elsewhere it counts as zero.
  if (op == Op::Equal || op == Op::NotEqual) {
    if (a.isVacant() || b.isVacant()) {
      if (a.kind == Value::Kind::Unknown || b.kind == Value::Kind::Unknown)
        return Truth::Unknown;
      const bool same = a.isVacant() && b.isVacant();
      return same == (op == Op::Equal) ? Truth::Yes : Truth::No;
    }
  }
  if (a.kind == Value::Kind::Unknown || b.kind == Value::Kind::Unknown)
    return Truth::Unknown;
  const Interval x = a.asNumber(), y = b.asNumber();
  const auto answer = [](bool yes, bool no) {
    return yes ? Truth::Yes : no ? Truth::No : Truth::Unknown;
  };
  switch (op) {
  case Op::Equal:
    return answer(x.isConstant() && x == y, x.hi < y.lo || y.hi < x.lo);
  case Op::NotEqual:
    return answer(x.hi < y.lo || y.hi < x.lo, x.isConstant() && x == y);
  case Op::Greater:
    return answer(x.lo > y.hi, x.hi <= y.lo);
  case Op::GreaterEqual:
    return answer(x.lo >= y.hi, x.hi < y.lo);
  case Op::Less:
    return answer(x.hi < y.lo, x.lo >= y.hi);
  case Op::LessEqual:
    return answer(x.hi <= y.lo, x.lo > y.hi);
  default:
    return Truth::Unknown;
  }
}

class Evaluator {
public:
  Evaluator(const Block &block, const MachineState &state, Outcome *outcome)
      : block_(block), state_(state), outcome_(outcome) {}

  Value run(const Expression &expression) {
    if (expression.bad)
      return Value::unknown();
    for (uint32_t i = 0; i < expression.count; ++i)
      step(block_.operations[expression.first + i]);
    return stack_.size() == 1 ? stack_.back() : Value::unknown();
  }

private:
  Value pop() {
    if (stack_.empty())
      return Value::unknown();
    return stack_.pop_back_val();
  }
  void domainError(const ExpressionOp &op) {
    if (outcome_)
      outcome_->emit(EventKind::DomainError).number = op.offset;
  }
  /// One constant in, one number out; anything else is unknown.
  template <typename F>
  void unary(F f) {
    const Value a = pop();
    const Interval x = a.asNumber();
    stack_.push_back(a.kind != Value::Kind::Unknown && x.isConstant() ? Value::of(f(x.value()))
                                                                      : Value::unknown());
  }
  void step(const ExpressionOp &op);
  void arithmetic(const ExpressionOp &op);

  const Block &block_;
  const MachineState &state_;
  Outcome *outcome_;
  llvm::SmallVector<Value, 8> stack_;
};

void Evaluator::arithmetic(const ExpressionOp &op) {
  const Value right = pop(), left = pop();
  if (left.kind == Value::Kind::Unknown || right.kind == Value::Kind::Unknown) {
    stack_.push_back(Value::unknown());
    return;
  }
  const Interval a = left.asNumber(), b = right.asNumber();
  switch (op.op) {
  case Op::Add:
    stack_.push_back(Value::of(a + b));
    return;
  case Op::Subtract:
    stack_.push_back(Value::of(a - b));
    return;
  case Op::Multiply:
    stack_.push_back(b.isConstant()   ? Value::of(a * b.value())
                     : a.isConstant() ? Value::of(b * a.value())
                                      : Value::unknown());
    return;
  case Op::Divide:
    if (b.isConstant() && b.value() == 0) {
      domainError(op);
      stack_.push_back(Value::unknown());
      return;
    }
    if (a.isConstant() && b.isConstant())
      stack_.push_back(Value::of(a.value() / b.value()));
    else
      stack_.push_back(b.isConstant() ? Value::of(a * (1 / b.value())) : Value::unknown());
    return;
  case Op::IntegerDivide:
    if (b.isConstant() && b.value() == 0)
      domainError(op);
    stack_.push_back(a.isConstant() && b.isConstant() && b.value() != 0
                         ? Value::of(std::trunc(a.value() / b.value()))
                         : Value::unknown());
    return;
  case Op::Minimum:
    stack_.push_back(Value::of(Interval{std::min(a.lo, b.lo), std::min(a.hi, b.hi)}));
    return;
  case Op::Maximum:
    stack_.push_back(Value::of(Interval{std::max(a.lo, b.lo), std::max(a.hi, b.hi)}));
    return;
  case Op::Power: {
    if (!a.isConstant() || !b.isConstant()) {
      stack_.push_back(Value::unknown());
      return;
    }
    // A root of a negative number, or a division by zero.
    if ((a.value() < 0 && b.value() != std::trunc(b.value())) ||
        (a.value() == 0 && b.value() < 0)) {
      domainError(op);
      stack_.push_back(Value::unknown());
      return;
    }
    const double power = std::pow(a.value(), b.value());
    stack_.push_back(std::isfinite(power) ? Value::of(power) : Value::unknown());
    return;
  }
  case Op::Modulo:
  case Op::FloorModulo: {
    if (b.isConstant() && b.value() == 0)
      domainError(op);
    if (!a.isConstant() || !b.isConstant() || b.value() == 0) {
      stack_.push_back(Value::unknown());
      return;
    }
    const double rest = std::fmod(a.value(), b.value());
    stack_.push_back(
        Value::of(op.op == Op::FloorModulo && rest < 0 ? rest + std::fabs(b.value()) : rest));
    return;
  }
  case Op::And:
  case Op::Or:
  case Op::Xor: {
    if (!a.isConstant() || !b.isConstant() || std::fabs(a.value()) > 1e15 ||
        std::fabs(b.value()) > 1e15) {
      // A false operand decides AND, a true one OR, whatever the other is.
      const Truth x = truthOf(left), y = truthOf(right);
      if (op.op == Op::And && (x == Truth::No || y == Truth::No))
        stack_.push_back(Value::of(0));
      else
        stack_.push_back(Value::unknown());
      return;
    }
    const auto x = int64_t(a.value()), y = int64_t(b.value());
    stack_.push_back(Value::of(double(op.op == Op::And  ? (x & y)
                                      : op.op == Op::Or ? (x | y)
                                                        : (x ^ y))));
    return;
  }
  case Op::Atan2:
    stack_.push_back(a.isConstant() && b.isConstant()
                         ? Value::of(std::atan2(a.value(), b.value()) / degree)
                         : Value::unknown());
    return;
  default:
    stack_.push_back(Value::unknown());
  }
}

void Evaluator::step(const ExpressionOp &op) {
  switch (op.op) {
  case Op::Number:
    stack_.push_back(Value::of(op.value));
    return;
  case Op::Vacant:
    stack_.push_back(Value::vacant());
    return;
  case Op::Variable:
    if (outcome_ && isUnset(state_, op.value))
      outcome_->emit(EventKind::UnsetRead).number = op.offset;
    stack_.push_back(readVariable(state_, int64_t(op.value)));
    return;
  case Op::ElementAt: {
    const Value index = pop();
    stack_.push_back(
        index.isConstant()
            ? readVariable(state_, int64_t(elementKey(uint64_t(op.value),
                                                      std::llround(index.number.value()))))
            : Value::unknown());
    return;
  }
  case Op::ElementKey: {
    const Value index = pop();
    stack_.push_back(
        index.isConstant()
            ? Value::of(double(elementKey(uint64_t(op.value), std::llround(index.number.value()))))
            : Value::unknown());
    return;
  }
  case Op::Not: {
    const Truth truth = truthOf(pop());
    stack_.push_back(truth == Truth::Unknown ? Value::unknown() : Value::of(truth == Truth::No));
    return;
  }
  case Op::Opaque:
    for (unsigned i = 0; i < unsigned(op.value); ++i)
      pop();
    stack_.push_back(Value::unknown());
    return;
  case Op::VariableAt: {
    const Value number = pop();
    const Interval n = number.asNumber();
    if (number.kind == Value::Kind::Unknown || !n.isConstant() || std::fabs(n.value()) > 1e15)
      stack_.push_back(Value::unknown());
    else
      stack_.push_back(readVariable(state_, std::llround(n.value())));
    return;
  }
  case Op::Negate: {
    const Value a = pop();
    // `-#1` of a vacant variable stays vacant.
    stack_.push_back(a.kind == Value::Kind::Number ? Value::of(a.number * -1) : a);
    return;
  }
  case Op::Equal:
  case Op::NotEqual:
  case Op::Greater:
  case Op::GreaterEqual:
  case Op::Less:
  case Op::LessEqual: {
    const Value b = pop(), a = pop();
    stack_.push_back(fromTruth(compare(op.op, a, b)));
    return;
  }
  case Op::Sin:
    return unary([](double x) { return std::sin(x * degree); });
  case Op::Cos:
    return unary([](double x) { return std::cos(x * degree); });
  case Op::Tan:
    return unary([](double x) { return std::tan(x * degree); });
  case Op::Asin:
  case Op::Acos: {
    const Interval x = stack_.empty() ? Interval() : stack_.back().asNumber();
    if (x.isConstant() && std::fabs(x.value()) > 1) {
      domainError(op);
      stack_.back() = Value::unknown();
      return;
    }
    if (op.op == Op::Asin)
      return unary([](double v) { return std::asin(v) / degree; });
    return unary([](double v) { return std::acos(v) / degree; });
  }
  case Op::Atan:
    return unary([](double x) { return std::atan(x) / degree; });
  case Op::Sqrt: {
    const Interval x = stack_.empty() ? Interval() : stack_.back().asNumber();
    if (x.isConstant() && x.value() < 0) {
      domainError(op);
      stack_.back() = Value::unknown();
      return;
    }
    return unary([](double v) { return std::sqrt(v); });
  }
  case Op::Ln: {
    const Interval x = stack_.empty() ? Interval() : stack_.back().asNumber();
    if (x.isConstant() && x.value() <= 0) {
      domainError(op);
      stack_.back() = Value::unknown();
      return;
    }
    return unary([](double v) { return std::log(v); });
  }
  case Op::Exp:
    return unary([](double x) { return std::exp(std::min(x, 700.0)); });
  case Op::Abs: {
    const Value a = pop();
    const Interval x = a.asNumber();
    if (a.kind == Value::Kind::Unknown)
      stack_.push_back(a);
    else if (x.lo >= 0)
      stack_.push_back(Value::of(x));
    else if (x.hi <= 0)
      stack_.push_back(Value::of(x * -1));
    else
      stack_.push_back(Value::of(Interval{0, std::max(-x.lo, x.hi)}));
    return;
  }
  case Op::Round:
    return unary([](double x) { return std::round(x); });
  case Op::Fix:
  case Op::Truncate:
    return unary([](double x) { return std::trunc(x); });
  case Op::Fup:
    return unary([](double x) { return x < 0 ? std::floor(x) : std::ceil(x); });
  case Op::Square:
    return unary([](double x) { return x * x; });
  case Op::Add:
  case Op::Subtract:
  case Op::Multiply:
  case Op::Divide:
  case Op::IntegerDivide:
  case Op::Minimum:
  case Op::Maximum:
  case Op::Modulo:
  case Op::FloorModulo:
  case Op::Power:
  case Op::And:
  case Op::Or:
  case Op::Xor:
  case Op::Atan2:
    return arithmetic(op);
  case Op::Floor:
    return unary([](double x) { return std::floor(x); });
  case Op::Ceiling:
    return unary([](double x) { return std::ceil(x); });
  case Op::Exists: {
    // Given a value on some path at least; one that all programs share may have it from elsewhere.
    const auto key = uint64_t(op.value);
    const bool local = key >= firstNamedVariable;
    const Truth given = local ? state_.locals.given(key) : state_.commons.given(key);
    stack_.push_back(given == Truth::Yes           ? Value::of(1)
                     : local && given == Truth::No ? Value::of(0)
                                                   : Value::of(Interval{0, 1}));
    return;
  }
  default:
    // BIN, BCD, ADP and what the reader could not resolve.
    if (op.op != Op::Unknown && !stack_.empty())
      stack_.pop_back();
    stack_.push_back(Value::unknown());
  }
}

/// Coordinate of the tool, as the program would write it.
Value coordinateOf(const MachineState &state, size_t axis) {
  const Interval &place = state.position[axis];
  if (state.machineAxes >> axis & 1 || !place.isConstant())
    return Value::unknown();
  const bool isLength = Axis(axis) < Axis::A || Axis(axis) > Axis::C;
  const uint64_t set = state.ranges.units == noGroup ? groupUnset : state.group(state.ranges.units);
  if (!isLength || !(set & state.ranges.inch))
    return Value::of(place.value());
  return set & ~state.ranges.inch ? Value::unknown()
                                  : Value::of(place.value() / millimetresPerInch);
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
  return Evaluator(block, state, outcome).run(block.expressions[index]);
}

namespace {
/// Whether the item gives a variable a value that what is at `offset` finds.
bool assignsBefore(const Item &item, uint32_t offset) {
  return item.kind == ItemKind::Assignment && item.begin < offset && item.value != noExpression;
}

/// Whether an expression may read a variable that the block assigns before it.
bool readsAssigned(const Block &block, const Expression &expression) {
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
    return assignsBefore(item, expression.begin) && reads(item);
  });
}
} // namespace

Value evaluateInBlock(const Block &block, uint16_t index, const MachineState &before) {
  const bool conditional =
      llvm::any_of(block.items, [](const Item &item) { return item.kind == ItemKind::If; });
  // Where names belong to the running program the control assigns after the block's words.
  if (index >= block.expressions.size() || block.items.empty() || conditional ||
      before.ranges.namedLocal || !readsAssigned(block, block.expressions[index]))
    return evaluate(block, index, before, nullptr);
  MachineState state = before;
  for (const Item &item : block.items)
    if (assignsBefore(item, block.expressions[index].begin))
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
  if (value.kind == Value::Kind::Unknown)
    return Truth::Unknown;
  const Interval x = value.asNumber();
  if (x.isConstant())
    return x.value() != 0 ? Truth::Yes : Truth::No;
  return x.contains(0) ? Truth::Unknown : Truth::Yes;
}

Value readVariable(const MachineState &state, int64_t number) {
  if (number == 0)
    return Value::vacant();
  if (const auto axis = placeOf(state, number))
    return coordinateOf(state, *axis);
  if (isLocal(state, number))
    return state.locals.get(uint64_t(number));
  if (isCommon(state, number))
    return state.commons.get(uint64_t(number));
  return Value::unknown();
}

bool isUnset(const MachineState &state, double number) {
  return number >= double(firstNamedVariable) &&
         state.locals.given(uint64_t(number)) == Truth::No &&
         state.commons.given(uint64_t(number)) == Truth::No;
}

void writeVariable(MachineState &state, int64_t number, const Value &value) {
  if (isLocal(state, number))
    state.locals.set(uint64_t(number), value);
  else if (isCommon(state, number))
    state.commons.set(uint64_t(number), value);
}

} // namespace ncvet
