// Evaluates expressions of the program on abstract values.
#pragma once

#include "formats/readers/block.h"
#include "interp/evaluate/variable_access.h"

namespace ncvet {

struct Outcome; // interp/state/event.h

/// Value of expression `index` of `block`. Domain errors and reads of vacant variables in
/// arithmetic are emitted into `outcome`, which may be null.
Value evaluate(const Block &block, uint16_t index, const MachineState &state, Outcome *outcome);

/// Value that the operation `place` of an expression takes from those before it: the index of an
/// element. Unknown when there is none.
Value operandOf(const Block &block, const Expression &expression, uint32_t place,
                const MachineState &state);

/// As `evaluate`, on the state before the block: its own assignments that are before the
/// expression act first.
Value evaluateInBlock(const Block &block, uint16_t index, const MachineState &before);
/// Value of a word as written, on a state in which the block's own assignments have acted already.
/// `wordValue` is for the state before the block.
Interval assignedWordValue(const Word &word, const Block &block, const MachineState &state);

/// The operations of an expression of `block`, in the order in which they are computed.
inline llvm::ArrayRef<ExpressionOp> operationsOf(const Block &block, const Expression &expression) {
  return llvm::makeArrayRef(block.operations).slice(expression.first, expression.count);
}

/// Truth of a value as a condition: comparisons give 1 or 0.
Truth truthOf(const Value &value);

/// Emits `UnsetRead` where the variable of the operation is unset, or is on some paths.
void emitUnsetRead(const MachineState &state, const ExpressionOp &op, Outcome &outcome);

} // namespace ncvet
