// The conditions that a path has decided.
#pragma once

#include "interp/evaluate/condition_key.h"
#include "interp/value/value.h"

namespace ncvet {

/// A condition that the states leave open, and that a path has decided all the same by going on in
/// one direction. A list that grows at its head and is shared by all states of the path.
struct DecidedCondition {
  uint64_t condition; ///< see `ConditionKey`
  bool holds;
  unsigned length = 1;
  const DecidedCondition *before = nullptr;
};

/// How the path has decided the condition; unknown: it has not.
Truth decided(const DecidedCondition *path, const ConditionKey &condition);

/// What two paths that meet have both decided, on the way that they have come together.
const DecidedCondition *decidedByBoth(const DecidedCondition *a, const DecidedCondition *b);

} // namespace ncvet
