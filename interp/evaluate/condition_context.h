// What the conditions and formulas of a dialect's table are tested against.
#pragma once

#include "formats/dialect/machine.h"
#include "formats/readers/block.h"

namespace ncvet {

struct CodeUse;      // interp/state/event.h
struct MachineState; // interp/state/state.h

/// All that a condition may ask about.
struct ConditionContext {
  const Dialect &dialect;
  const MachineProfile &machine;
  const Block &block;
  llvm::ArrayRef<CodeUse> codes; ///< of the block
  const MachineState &before;
  /// Words of a cycle that the block lacks are those that `before` keeps of an earlier block.
  bool keptWords = false;
  double index = 0; ///< of the place in a pattern, from 0
};

} // namespace ncvet
