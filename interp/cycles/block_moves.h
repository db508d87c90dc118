// The motions that one executed block makes.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/state/event.h"
#include "interp/state/move.h"

#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// An executed block.
struct ExecutedBlock {
  const Dialect &dialect;
  const MachineProfile &machine;
  const Block &block;
  const Outcome &outcome;
  const MachineState &before;
  const MachineState &after;
};

/// Gives `move` the feed that is in force in `state`.
void setFeed(const Dialect &dialect, const MachineState &state, Move &move);

/// Appends the rapid that leads to where the block begins, for a tool that is elsewhere.
void appendReturn(const ExecutedBlock &executed, llvm::SmallVectorImpl<Move> &moves);

/// Appends what the block does, in the order in which the control does it: tool, spindle, dwell,
/// motions with cycles expanded, end; in the coordinates of the work offset, frames resolved.
/// Straight lines and arcs end at the programmed point: corners between two blocks and the tool's
/// radius are not looked at.
void appendMoves(const ExecutedBlock &executed, llvm::SmallVectorImpl<Move> &moves);

} // namespace ncvet
