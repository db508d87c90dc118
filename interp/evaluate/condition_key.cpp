// What an expression asks of variables that a program leaves as they are.
#include "interp/evaluate/condition_key.h"

#include "interp/evaluate/variable_access.h"

#include "llvm/ADT/Hashing.h"
#include "llvm/ADT/bit.h"

namespace ncvet {

namespace {

/// The comparison that holds where `op` does not, if it is the one that has no key of its own.
std::optional<Op> oppositeOf(Op op) {
  switch (op) {
  case Op::NotEqual:
    return Op::Equal;
  case Op::GreaterEqual:
    return Op::Less;
  case Op::LessEqual:
    return Op::Greater;
  default:
    return std::nullopt;
  }
}

/// Whether the operation has the same result whenever its operands have.
bool isSteady(const ExpressionOp &op, const MachineState &state) {
  switch (op.op) {
  case Op::VariableAt:
  case Op::ElementAt:
  case Op::ElementKey:
  case Op::Opaque:
    return false;
  case Op::Variable:
    return isUntouched(state, op.value);
  default:
    return true;
  }
}

} // namespace

ConditionKey conditionKey(const Block &block, uint16_t index, const MachineState &state) {
  if (index == noExpression || block.expressions[index].bad)
    return {};
  const Expression &expression = block.expressions[index];
  llvm::ArrayRef<ExpressionOp> all =
      llvm::makeArrayRef(block.operations).slice(expression.first, expression.count);
  ConditionKey key;
  for (; !all.empty() && all.back().op == Op::Not; all = all.drop_back())
    key.negated = !key.negated;
  if (all.empty())
    return {};
  llvm::hash_code sum(1);
  for (const ExpressionOp &op : all) {
    if (!isSteady(op, state))
      return {};
    const std::optional<Op> opposite = &op == &all.back() ? oppositeOf(op.op) : std::nullopt;
    key.negated ^= opposite.has_value();
    sum = llvm::hash_combine(sum, uint8_t(opposite.value_or(op.op)),
                             llvm::bit_cast<uint64_t>(op.value));
  }
  key.sum = std::max<uint64_t>(sum, 1);
  return key;
}

} // namespace ncvet
