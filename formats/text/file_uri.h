// `file:` URIs and paths.
#pragma once

#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Path.h"

#include <string>

namespace ncvet {

/// Path of a `file:` URI, its escapes resolved, with `/` as separator; of any other URI the URI
/// itself, which is no path of a file.
std::string pathOfUri(llvm::StringRef uri,
                      llvm::sys::path::Style style = llvm::sys::path::Style::native);
/// URI of an absolute path; what is no absolute path is returned as it is.
std::string uriOfPath(llvm::StringRef path,
                      llvm::sys::path::Style style = llvm::sys::path::Style::native);

/// The path with `/` as separator, as every system takes it and reports show it.
std::string slashed(llvm::StringRef path);

} // namespace ncvet
