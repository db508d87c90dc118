// Unified diff of two texts.
#pragma once

#include "llvm/ADT/StringRef.h"
#include "llvm/Support/raw_ostream.h"

namespace ncvet {

/// Writes the differences of two texts as `diff -u` would, with three lines around each; nothing
/// when they are equal. Line ends stay as they are. `patch` can apply the result. It is exact, but
/// not always the shortest: where more than a few hundred lines in a row differ, they are shown as
/// replaced.
void writeUnifiedDiff(llvm::StringRef before, llvm::StringRef after, llvm::StringRef name,
                      llvm::raw_ostream &out);

} // namespace ncvet
