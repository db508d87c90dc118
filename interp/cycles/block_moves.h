// The motions that one executed block makes.
#pragma once

#include "interp/geometry/move.h"
#include "interp/state/executed_block.h"

#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// Appends the rapid that leads to where the block begins, for a tool that is elsewhere.
void appendReturn(const ExecutedBlock &executed, llvm::SmallVectorImpl<Move> &moves);

/// Appends what the block does, in the order in which the control does it: tool, spindle, dwell,
/// motions with cycles expanded, end; in the coordinates of the work offset, frames resolved.
/// Straight lines and arcs end at the programmed point: corners between two blocks and the tool's
/// radius are not looked at.
void appendMoves(const ExecutedBlock &executed, llvm::SmallVectorImpl<Move> &moves);

} // namespace ncvet
