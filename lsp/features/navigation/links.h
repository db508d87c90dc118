// Names in a document that lead into other files.
#pragma once

#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

struct Link {
  SourceRange range; ///< the name of a called program
  std::string path;  ///< of the file that holds it
};

/// In the order of the text.
std::vector<Link> links(Snapshot &snapshot);

} // namespace ncvet::lsp
