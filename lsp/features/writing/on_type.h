// Edits while typing: the number of a new block.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// What to insert when a line end was just typed and `offset` lies in the new line: the number of
/// the next block, where the blocks before it have numbers. Its step is theirs; between two
/// numbers without room for that it lies in the middle. None where blocks are not numbered, the
/// line has a number, or no number is free.
std::optional<TextEdit> numberOfNewBlock(Snapshot &snapshot, uint32_t offset);

} // namespace ncvet::lsp
