// Makes of a block that has been executed a move that is known in these modes.
#pragma once

#include "interp/execute/known_move.h"
#include "interp/execute/mode_masks.h"

namespace ncvet {

/// What executing `block` did, for any block that is spelled as it (see `spellingOf`, with
/// `knownCoordinates`) in these modes (see `modesNumber`); nothing when its numbers decide more
/// than where it leads. `use`: what executing it has looked at. Nothing of what is looked at here
/// is noted.
std::optional<KnownMove> makeKnownMove(const Dialect &dialect, const MachineProfile &machine,
                                       const ModeMasks &masks, FileId file, const Block &block,
                                       const MachineState &before, MachineState &after,
                                       Outcome &outcome, const StateUse &use);

/// The words whose numbers may be any in a block of a known spelling.
AddressMask knownCoordinates(const Dialect &dialect);

} // namespace ncvet
