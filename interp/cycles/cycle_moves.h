// The motions of canned cycles, by the shape that the table gives each and the levels of its words.
#pragma once

#include "interp/geometry/move.h"
#include "interp/state/executed_block.h"

#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// Appends the motions of one run of a cycle: `event` is its CycleRun. A cycle whose motions are
/// not known ends where the state says, in one rapid.
void appendCycleMoves(const ExecutedBlock &executed, const Event &event,
                      llvm::SmallVectorImpl<Move> &moves);

/// Drilling, tapping, boring at each of the block's places.
void appendDrillingMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                         llvm::SmallVectorImpl<Move> &moves);
/// Threads cut by turning; false when the cycle is none, or a parameter block.
bool appendThreadMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                       llvm::SmallVectorImpl<Move> &moves);
/// Pockets, slots, faces, islands as their envelope; false when the table does not say where.
bool appendAreaMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                     llvm::SmallVectorImpl<Move> &moves);
/// Pass by pass beside a line along Z (CycleKind::ThreadInfeed).
void appendInfeedThreadMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                             llvm::SmallVectorImpl<Move> &moves);
/// Pass by pass along a chain of places (CycleKind::ThreadChain).
void appendThreadChainMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                            llvm::SmallVectorImpl<Move> &moves);
/// Along the helix of a thread (CycleKind::ThreadMill).
void appendThreadMillingMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                              llvm::SmallVectorImpl<Move> &moves);
/// Single passes and grooves; false when the cycle is none of these.
bool appendTurningMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                        llvm::SmallVectorImpl<Move> &moves);

} // namespace ncvet
