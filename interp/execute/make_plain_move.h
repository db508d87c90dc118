// Makes of a block that has been executed a plain move that may follow itself.
#pragma once

#include "interp/execute/mode_masks.h"
#include "interp/execute/plain_move.h"

namespace ncvet {

/// `block`, which has just been executed with this outcome, as a move that may be made again with
/// other numbers; nothing when it is none. Of what it looks at nothing is noted.
std::optional<PlainMove> makePlainMove(const Dialect &dialect, const MachineProfile &machine,
                                       const ModeMasks &masks, FileId file, const Block &block,
                                       MachineState &after, Outcome &outcome);

} // namespace ncvet
