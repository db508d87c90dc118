// Completion: what may be written at the cursor.
#pragma once

#include "lsp/features/snapshot.h"
#include "lsp/features/writing/completion_item.h"

namespace ncvet {
struct MachineState; // interp/state/state.h
}

namespace ncvet::lsp {

/// What fits at byte `offset`, the likely first; a few thousand at most. `before` is the state on
/// entry of the block; null: nothing is known.
std::vector<CompletionItem> completions(Snapshot &snapshot, uint32_t offset,
                                        const MachineState *before = nullptr);

/// The documentation of an item, Markdown; empty for an unknown id.
std::string completionHelp(const Dialect &dialect, llvm::StringRef id);

} // namespace ncvet::lsp
