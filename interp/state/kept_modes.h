// Modes that a program keeps, to bring them back later: M70 to M73 of LinuxCNC.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/state/state.h"

namespace ncvet {

/// What is kept of `state` (LinuxCNC 2.9, section 11.6.19).
SavedModes keepModes(const Dialect &dialect, const MachineState &state);

/// Brings the modes back. The motion and the cycle stay what they are, and so does the tool: it
/// gets other coordinates where the zero point becomes another one.
void bringBack(const Dialect &dialect, const MachineProfile &machine, MachineState &state,
               const SavedModes &saved);

} // namespace ncvet
