// All places that use the name at a place of a document.
#pragma once

#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// Places of the name at the byte `offset`, those of the document first, in the order of the text.
/// `definitions`: places that define it are wanted too. Programs are looked for in the files
/// `paths` as well, as far as their calls lead to the same program.
std::vector<SourceRange> references(Snapshot &snapshot, uint32_t offset, bool definitions,
                                    llvm::ArrayRef<std::string> paths = {});

} // namespace ncvet::lsp
