// The feed of a motion, from the state in which it is made.
#pragma once

#include "interp/geometry/move.h"
#include "interp/state/state.h"

namespace ncvet {

/// Gives `move` the feed that is in force in `state`.
void setFeed(const Dialect &dialect, const MachineState &state, Move &move);

} // namespace ncvet
