// Tests the conditions of a dialect's table against a block and the state before it.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/state/event.h"

namespace ncvet {

/// The word of the block's last assignment to the variable with this key, or null.
const Word *assignmentOf(const Block &block, uint64_t variable);
/// The word of the block that `spec` speaks of: by its address, its place among the arguments, or
/// the variable that it sets. Null when there is none; an argument left empty counts as none.
const Word *wordFor(const Block &block, const WordSpec &spec);

/// Key of the variable used in place of `spec`'s word: the one of its two that the program has
/// given a value.
uint64_t givenVariable(const WordSpec &spec, const MachineState &state);
/// Whether blocks before have given the variable used in place of `spec`'s word a value.
Truth givenBefore(const WordSpec &spec, const MachineState &state);

/// The code that a word is, without its variants; `noCode` for other words and unknown codes.
CodeIndex codeOf(const Dialect &dialect, const Word &word);

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

/// Whether `condition` certainly holds. `code` is the code whose entry holds the condition.
bool holds(const Condition &condition, const CodeInfo *code, const ConditionContext &context);

/// Whether a known value breaks the test's bounds; false when it keeps them or is not known.
bool breaks(const ValueTest &test, const Word &word, const ConditionContext &context);

/// Value of a word as written: a number, or an expression's value on the state.
Interval wordValue(const Word &word, const Block &block, const MachineState &state);

} // namespace ncvet
