// What an expression asks of variables that a program leaves as they are.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

struct MachineState; // interp/state/state.h

/// A condition, so that the same one is known again wherever a program has it.
struct ConditionKey {
  uint64_t sum = 0;     ///< 0: the next time it may have another value
  bool negated = false; ///< it holds where that of `sum` does not: `NE` of `EQ`, `GE` of `LT`
};

/// The key of expression `index` of `block` in `state`. It has one where all that the expression
/// reads are numbers and variables of programs to which this one has given no value on any path:
/// they keep what the operator, or another program, has put there.
ConditionKey conditionKey(const Block &block, uint16_t index, const MachineState &state);

} // namespace ncvet
