// Tests the conditions of a dialect's table against a block and the state before it.
#pragma once

#include "interp/evaluate/block_words.h"
#include "interp/evaluate/condition_context.h"

namespace ncvet {

/// Whether `condition` certainly holds. `code` is the code whose entry holds the condition.
bool holds(const Condition &condition, const CodeInfo *code, const ConditionContext &context);

/// Whether a condition asks for the value of a word of the block.
inline bool asksNumber(const Condition &condition) {
  return !condition.broken.empty() || !condition.formula.empty();
}

/// Whether a known value breaks the test's bounds; false when it keeps them or is not known.
bool breaks(const ValueTest &test, const Word &word, const ConditionContext &context);

} // namespace ncvet
