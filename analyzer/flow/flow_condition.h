// On what it depends where control goes from a block.
#pragma once

#include "interp/evaluate/condition_key.h"

namespace ncvet {

struct Step; // analyzer/flow/activation.h

/// The key of the condition in the block of the step; without a sum where it has none.
ConditionKey conditionOf(const Step &step);

} // namespace ncvet
