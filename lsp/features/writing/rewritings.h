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

} // namespace ncvet::lsp
