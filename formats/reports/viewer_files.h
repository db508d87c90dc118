// The files of formats/reports/viewer that are compiled into the binary.
#pragma once

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/StringRef.h"

namespace ncvet {

struct ViewerFile {
  llvm::StringRef name; ///< "page.html"
  llvm::StringRef text;
};

/// All of them, sorted by name.
llvm::ArrayRef<ViewerFile> viewerFiles();

} // namespace ncvet
