// Paths that mean the same file whatever the current folder is later.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <string>

namespace ncvet::cli {

/// The path from the root; as it is when the current folder cannot be found out.
std::string absolutePath(llvm::StringRef name);

} // namespace ncvet::cli
