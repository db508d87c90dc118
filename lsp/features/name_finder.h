// Finds the names of a file in one pass over its blocks.
#pragma once

#include "lsp/features/names.h"

namespace ncvet::lsp {

/// What `Names` is made of.
struct FoundNames {
  std::vector<Occurrence> all; ///< in the order of the text
  std::vector<Scope> scopes;
  std::vector<UntoldNames> untold; ///< by program
};

/// All that the engine would follow or evaluate, taken from the blocks as the reader gives them.
FoundNames findNames(const FileUnit &unit);

} // namespace ncvet::lsp
