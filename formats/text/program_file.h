// Reads whole files that a user, a folder or a configuration names.
#pragma once

#include "llvm/Support/Error.h"
#include "llvm/Support/MemoryBuffer.h"

namespace ncvet {

/// The bytes of a regular file, or of a pipe into which another program writes, of at most `most`
/// bytes. A device, and a pipe into which nothing writes, would never end: they fail, with the
/// reason alone as text.
llvm::Expected<std::unique_ptr<llvm::MemoryBuffer>> readWholeFile(llvm::StringRef path,
                                                                  uint64_t most);

/// Whether a folder's entry may be opened: nothing but a regular file is one of its programs.
bool isRegularFile(llvm::StringRef path);

} // namespace ncvet
