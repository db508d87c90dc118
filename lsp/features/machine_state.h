// The machine's state at a block, in words.
#pragma once

#include "analyzer/flow/states_at_block.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// Markdown: modal codes, position, tool, offsets, feed, speed, compensation and cycle on entry of
/// the block that the states are of, as sets where ways differ, and the calls that lead there.
/// Empty when no way leads there.
std::string machineState(Snapshot &snapshot, const StatesAt &states);

} // namespace ncvet::lsp
