// What a breakpoint looks at.
#include "lsp/debug/watched_value.h"

#include "formats/dialect/vocabulary.h"
#include "interp/evaluate/expression.h"
#include "interp/state/state.h"

namespace ncvet::dap {

namespace {

struct Sign {
  llvm::StringLiteral text;
  Operator compares;
};

/// Longer ones before those with which they begin.
constexpr Sign signs[] = {
    {">=", Operator::GreaterEqual}, {"<=", Operator::LessEqual}, {"==", Operator::Equal},
    {"!=", Operator::NotEqual},     {"<>", Operator::NotEqual},  {">", Operator::Greater},
    {"<", Operator::Less},          {"=", Operator::Equal},      {" GE ", Operator::GreaterEqual},
    {" LE ", Operator::LessEqual},  {" EQ ", Operator::Equal},   {" NE ", Operator::NotEqual},
    {" GT ", Operator::Greater},    {" LT ", Operator::Less}};

bool isLetter(llvm::StringRef text) {
  const std::string name = text.upper();
  return llvm::is_contained(axisNames(), name) || name == "F" || name == "S" || name == "T";
}

} // namespace

std::optional<Value> letterValue(llvm::StringRef text, const MachineState &state) {
  const std::string name = text.upper();
  for (size_t axis = 0; axis < axisCount; ++axis)
    if (axisNames()[axis] == name)
      return Value::of(state.position[axis]);
  if (name == "F")
    return Value::of(state.feed);
  if (name == "S")
    return Value::of(state.speed);
  if (name == "T" && state.tool >= 0)
    return Value::of(double(state.tool));
  return std::nullopt;
}

llvm::Expected<WatchedValue> WatchedValue::parse(const FileUnit &unit, llvm::StringRef text) {
  WatchedValue made;
  if (isLetter(text.trim())) {
    made.letter_ = text.trim().str();
    return made;
  }
  auto expression = WatchExpression::parse(unit, text);
  if (!expression)
    return expression.takeError();
  made.expression_ = std::move(*expression);
  return made;
}

Value WatchedValue::evaluate(const MachineState &state) const {
  if (expression_)
    return expression_->evaluate(state);
  return letterValue(letter_, state).value_or(Value::unknown());
}

llvm::Expected<WatchedCondition> WatchedCondition::parse(const FileUnit &unit,
                                                         llvm::StringRef text) {
  WatchedCondition made;
  const std::string upper = text.upper();
  for (const Sign &sign : signs) {
    const size_t at = llvm::StringRef(upper).find(sign.text);
    if (at == llvm::StringRef::npos || !isLetter(text.take_front(at).trim()))
      continue;
    auto right = WatchedValue::parse(unit, text.drop_front(at + sign.text.size()));
    if (!right)
      return right.takeError();
    made.left_ = *WatchedValue::parse(unit, text.take_front(at));
    made.compares_ = sign.compares;
    made.right_ = std::move(*right);
    return made;
  }
  auto whole = WatchedValue::parse(unit, text);
  if (!whole)
    return whole.takeError();
  made.left_ = std::move(*whole);
  return made;
}

Truth WatchedCondition::holds(const MachineState &state) const {
  if (!right_)
    return truthOf(left_.evaluate(state));
  OperatorStack stack({});
  stack.push(left_.evaluate(state));
  stack.push(right_->evaluate(state));
  stack.apply(compares_);
  return truthOf(stack.result());
}

} // namespace ncvet::dap
