// Small files read whole, and never without end.
#pragma once

#include "llvm/Support/Error.h"
#include "llvm/Support/MemoryBuffer.h"

#include <memory>

namespace ncvet {

/// No configuration, table or profile that somebody wrote is as large.
constexpr uint64_t largestSettings = 64u << 20;

/// Reads a file or a pipe of at most `limit` bytes. Fails with one line that names the file for
/// what cannot be read: folders and devices, which may never end, and what is larger.
llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readFile(llvm::StringRef path,
                                                             uint64_t limit = largestSettings);

} // namespace ncvet
