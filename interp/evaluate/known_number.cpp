// Expressions of numbers that are all known: most of those in loops.
#include "interp/evaluate/known_number.h"

#include "interp/evaluate/program_operators.h"
#include "interp/evaluate/variable_access.h"
#include "interp/state/state.h"

namespace ncvet {

namespace {

/// Operands that wait for their operators; those of an expression that is written by hand are few.
constexpr size_t mostOperands = 8;

/// The number that the variable has for certain.
std::optional<double> numberIn(const MachineState &state, double key) {
  if (!(key < pastNumbers) ||
      (key >= double(firstNamedVariable) && isUnset(state, key) != Truth::No))
    return std::nullopt;
  const Value value = readVariable(state, int64_t(key));
  return value.isConstant() ? std::optional(value.number.value()) : std::nullopt;
}

} // namespace

std::optional<double> knownNumber(const Block &block, uint16_t index, const MachineState &state) {
  if (index >= block.expressions.size())
    return std::nullopt;
  std::array<double, mostOperands> operands;
  size_t count = 0;
  const Expression &expression = block.expressions[index];
  for (const ExpressionOp &op :
       llvm::makeArrayRef(block.operations).slice(expression.first, expression.count)) {
    std::optional<double> number;
    if (op.op == Op::Number)
      number = op.value + 0.0; // no -0
    else if (op.op == Op::Variable)
      number = numberIn(state, op.value);
    else if (const std::optional<Operator> known = programOperators[size_t(op.op)])
      number = compute(*known, operands.data(), count);
    if (!number || count == mostOperands)
      return std::nullopt;
    operands[count++] = *number;
  }
  return count == 1 ? std::optional(operands[0]) : std::nullopt;
}

} // namespace ncvet
