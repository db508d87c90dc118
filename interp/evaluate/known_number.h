// Expressions of numbers that are all known.
#pragma once

#include "formats/readers/block.h"

#include <optional>

namespace ncvet {

struct MachineState; // interp/state/state.h

/// Value of an expression of `block` that is one number because all its operands are, and that has
/// nothing to tell. Nothing: `evaluate` says more of it.
std::optional<double> knownNumber(const Block &block, uint16_t index, const MachineState &state);

} // namespace ncvet
