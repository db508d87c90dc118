// All modes of a state as one number.
#pragma once

#include "interp/state/state.h"

namespace ncvet {

/// A number for all that the state knows but for coordinates, levels, the words of the cycle in
/// force, and variables: codes in force, facts of the past, tool and technology, switches,
/// compensation, and which of cycle and compensation is older than the tool. Nothing is noted as
/// looked at.
uint64_t modesNumber(const Dialect &dialect, const MachineState &state);

} // namespace ncvet
