// Blocks that only calculate: what they do when they are executed again.
#pragma once

#include "interp/state/event.h"

namespace ncvet {

/// A block of statements that asks for one condition at most, and gives a value to one variable at
/// most: found out from its text, once.
struct Calculation {
  uint16_t condition = noExpression; ///< of IF and WHILE; `noExpression`: none is asked
  bool guards = false;               ///< the assignment is made only where the condition holds
  uint64_t target = 0;               ///< key of the variable that gets a value; 0: none does
  uint16_t value = noExpression;
};

/// What the block calculates; nothing when it is of another kind.
std::optional<Calculation> calculationOf(const Block &block);

/// What a calculation gave, where all its numbers are known.
struct Calculated {
  Truth condition = Truth::Yes; ///< `Yes` also where none is asked
  bool writes = false;
  double value = 0; ///< of the variable that is written

  Value written() const { return {Value::Kind::Number, {value, value}}; }
};

/// Works it out for a state, which stays as it is. Nothing: some number is not known.
std::optional<Calculated> calculate(const Block &block, const Calculation &calculation,
                                    const MachineState &state);

} // namespace ncvet
