// Which words of a block are chamfers, roundings and line angles.
#pragma once

#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {

/// The words by which a control writes corners and lines by angle.
struct CornerAddresses {
  AddressMask chamfer = 0;  ///< `,C`, or I and K
  AddressMask rounding = 0; ///< `,R`, or R
  AddressMask angle = 0;    ///< `,A`, or A
  AddressMask plain = 0;    ///< of these: letters that mean something else in other blocks
  AddressMask corner() const { return chamfer | rounding; }
};

/// The addresses that the dialect's linear move takes as corners and angles.
CornerAddresses cornerAddresses(const Dialect &dialect);

/// Whether the current block is a straight feed move without a code that reads `letters` otherwise.
bool isLine(const RuleContext &ctx, const Event &motion);
/// True when a code of the block other than a motion takes one of the letters for itself.
bool takenByOther(const RuleContext &ctx, AddressMask letters);

/// Whether the block's word asks for a corner: the letter of an axis does only while the main
/// spindle turns, see `isCornerOfAxis`.
bool asksForCorner(const RuleContext &ctx, const Word &word);

/// Blocks without a move that may be between the two moves of a corner written with a comma.
constexpr unsigned blocksBetweenMoves = 3;

/// Reads the block that the corner of the current block has to reckon with: the next one, or, past
/// at most `between` blocks that neither move nor run a cycle, the one after these. False when
/// none is found, or when something decides at run time what comes. `passed`: it is not the next.
bool readNeighbour(const RuleContext &ctx, BlocksAhead &ahead, Block &next, unsigned between,
                   bool &passed);

/// Axes that the words of a block that was read ahead name.
uint16_t axesOf(const RuleContext &ctx, const Block &block);

} // namespace ncvet
