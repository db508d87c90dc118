// Gives the name at a place of a document another spelling everywhere, or says why not.
#pragma once

#include "formats/text/edit.h"
#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// What would be renamed.
struct RenameSpot {
  SourceRange range;   ///< the name at the place
  std::string name;    ///< as it is spelled there
  std::string refused; ///< why it keeps its name, one line; empty: it may be renamed
};

/// The name at the byte `offset`. Refused is what other files or only the run know: names that are
/// defined elsewhere, variables of the control, blocks where a target is computed.
RenameSpot prepareRename(Snapshot &snapshot, uint32_t offset);

struct RenameEdits {
  std::vector<TextEdit> edits; ///< of the document, ascending
  std::string refused;         ///< why there are none, one line
};

/// Labels, variables, block numbers with all targets, subprograms between brackets, and programs of
/// this file. The new text means the same as the old one: it is read again before it is given.
RenameEdits rename(Snapshot &snapshot, uint32_t offset, llvm::StringRef name);

/// The new name as it is written in one place of a file.
std::string spelledName(const FileUnit &unit, const Occurrence &place, llvm::StringRef name);

} // namespace ncvet::lsp
