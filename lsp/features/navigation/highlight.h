// The places of a document that hold the same name as the one under the cursor.
#pragma once

#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

struct Highlight {
  SourceRange range;
  bool writes = false; ///< defines the name, or gives the variable a value; else it is read
};

/// In the order of the text; empty when there is no name at the byte `offset`.
std::vector<Highlight> highlights(Snapshot &snapshot, uint32_t offset);

} // namespace ncvet::lsp
