// Files that the commands write.
#pragma once

#include "llvm/ADT/STLExtras.h"
#include "llvm/Support/Error.h"
#include "llvm/Support/raw_ostream.h"

#include <string>

namespace ncvet::cli {

/// Writes a file; `-` is standard output, whose errors are told when the command has ended. An
/// error names the file.
llvm::Error writeFile(const std::string &file, llvm::function_ref<void(llvm::raw_ostream &)> write);

} // namespace ncvet::cli
