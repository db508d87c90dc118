// Changes of selected blocks after which the machine does the same, or the same elsewhere.
#pragma once

#include "lsp/features/writing/selection.h"

namespace ncvet::lsp {

/// All of these are proved: refused where the machine would do anything else than the title says.

/// Puts a block skip before every selected block, or takes it away where all have one.
Rewriting toggleBlockSkip(Selection &selection);
/// Numbers the numbered ones of the selected blocks anew, between the numbers around them, in steps
/// of `step` or smaller ones; what names them follows.
Rewriting renumberSelection(Selection &selection, int64_t step);
/// Gives the coordinates of the selected blocks as distances.
Rewriting toIncremental(Selection &selection);
/// Gives them as places.
Rewriting toAbsolute(Selection &selection);
/// Changes the coordinates of the selected blocks, and with them centres and radii of arcs, their
/// direction and the side of the compensation. What is incremental is not shifted.
Rewriting transform(Selection &selection, const AxisChanges &changes, std::string title);

/// The rest is proved as well: the machine does exactly the same.

/// Writes the loops and repeats of the selection out, each pass after the other.
Rewriting unroll(Selection &selection);
/// Writes the blocks of the program that the selected block calls in the place of the call.
Rewriting inlineCall(Selection &selection);
/// Writes the moves of the selection's canned cycles in the place of the cycles.
Rewriting cyclesToMoves(Selection &selection);
/// Makes a row of holes of the selection, each drilled in one move, a canned cycle.
Rewriting movesToCycle(Selection &selection);
/// Makes the selected blocks a subprogram, and calls it in their place.
Rewriting extractSubprogram(Selection &selection);

} // namespace ncvet::lsp
