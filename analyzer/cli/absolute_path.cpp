// Paths from the root.
#include "analyzer/cli/absolute_path.h"

#include "llvm/ADT/SmallString.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/Path.h"

namespace ncvet::cli {

std::string absolutePath(llvm::StringRef name) {
  llvm::SmallString<256> whole = name;
  if (llvm::sys::fs::make_absolute(whole))
    return name.str();
  llvm::sys::path::remove_dots(whole);
  return std::string(whole);
}

} // namespace ncvet::cli
