// URIs of documents, and their paths.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <string>

namespace ncvet::lsp {

/// Path of a `file:` URI, its escapes resolved; of any other URI the URI itself, which is no path
/// of a file.
std::string pathOfUri(llvm::StringRef uri);
/// URI of an absolute path; what is no absolute path is returned as it is.
std::string uriOfPath(llvm::StringRef path);

} // namespace ncvet::lsp
