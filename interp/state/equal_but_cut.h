// Compares states in all but where the tool has cut, at which few programs look.
#pragma once

#include <cstdint>

namespace ncvet {

struct KnownState;   // interp/state/state.h
struct MachineState; // the same

/// As `equal` and `hash`, but for `MotionState::cutArea`.
bool equalButCut(const KnownState &a, const KnownState &b);
uint64_t hashButCut(const MachineState &state);

} // namespace ncvet
