// All places that use the name at a place of a document.
#pragma once

#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

#include <functional>

namespace ncvet::lsp {

/// Who is told while places are gathered in files beside the document's.
struct GatherSteps {
  /// So many of the files have been looked through.
  std::function<void(size_t files)> looked;
  /// Takes the places that were found since the last time; null: all are given at the end.
  std::function<void(std::vector<SourceRange>)> found;
};

/// Places of the name at the byte `offset`, those of the document first, in the order of the text.
/// `definitions`: places that define it are wanted too. Programs are looked for in the files
/// `paths` as well, as far as their calls lead to the same program.
std::vector<SourceRange> references(Snapshot &snapshot, uint32_t offset, bool definitions,
                                    llvm::ArrayRef<std::string> paths = {},
                                    const GatherSteps &steps = {});

} // namespace ncvet::lsp
