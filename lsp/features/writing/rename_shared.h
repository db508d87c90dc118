// A variable that programs of several files share, with another name in all of them.
#pragma once

#include "formats/text/edit.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

struct SharedRename {
  std::vector<TextEdit> edits; ///< of all files, those of one file ascending
  std::string refused;         ///< why there are none, one line
};

/// Whether the name at the byte `offset` is a variable that all programs share: `#102`, `R5`.
bool isSharedVariable(Snapshot &snapshot, uint32_t offset);

/// The variable at `offset` in the document, in the files that its programs call, in those that
/// call them, and so on. `paths`: the programs of the workspace. Refused is a variable whose value
/// may come from elsewhere, or that a program which is not known may see.
SharedRename renameShared(Snapshot &snapshot, uint32_t offset, llvm::StringRef name,
                          llvm::ArrayRef<std::string> paths);

/// Why the variable keeps its name whatever the other one is; empty: it may get another one.
std::string whyNotShared(Snapshot &snapshot, uint32_t offset, llvm::ArrayRef<std::string> paths);

} // namespace ncvet::lsp
