// What a growing selection takes in, from the word under the cursor to the file.
#pragma once

#include "lsp/features/parts.h"

namespace ncvet::lsp {

/// For each of `offsets` its ranges from inner to outer, each inside the next and larger than the
/// one before: name, word or comment, block, the parts and loops around it, program, file.
std::vector<std::vector<SourceRange>> selections(Snapshot &snapshot,
                                                 llvm::ArrayRef<uint32_t> offsets);

} // namespace ncvet::lsp
