// Shapes of blocks: what is known of one block holds for all that differ from it in coordinates.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// A number for the shape of a block that has been executed: its codes and addresses, how its words
/// are spelled, the values of those that are no coordinates, and its events. Blocks of the same
/// number have the same shape. 0: the block has none, because more than that decides what it means
/// (statements, expressions, bad text, a block skip, another tool). Of a block that is called, how
/// deep and whether as a macro belongs to its shape, not from where.
uint64_t shapeOf(const Dialect &dialect, const Block &block, const Outcome &outcome,
                 const CallSite *caller = nullptr);

/// The same of a block that is executed again: `place` is a number for file and offset. It is that
/// of no other block, nor of one that is called from elsewhere.
uint64_t shapeAt(uint64_t place, const CallSite *caller, const Block &block,
                 const Outcome &outcome);

/// A number for those parts of the states before and after a block that `use` names, and for the
/// modes that every rule may look at without notice: compensation and whether blocks without a move
/// in its plane came last, profiles, transformations, cycles, modal calls.
uint64_t modesOf(const StateUse &use, const MachineState &before, const MachineState &after);

bool isSame(const StateUse &a, const StateUse &b);

/// Whether `modesOf` covers all that was looked at.
bool coversModes(const StateUse &use);

} // namespace ncvet
