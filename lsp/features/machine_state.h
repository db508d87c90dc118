// The machine's state at a block, in words.
#pragma once

#include "analyzer/states_at.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// Markdown: modal codes, position, tool, offsets, feed, speed, compensation and cycle on entry of
/// the block that holds `offset`, as sets where ways differ, and the calls that lead there. Empty
/// when no way leads there. `runs`: see `analyze`.
std::string machineState(Snapshot &snapshot, uint32_t offset,
                         const std::atomic<bool> *cancel = nullptr, StraightRuns *runs = nullptr);

} // namespace ncvet::lsp
