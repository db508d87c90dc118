// Whether two texts of a block mean the same.
#pragma once

#include "formats/readers/block.h"

namespace ncvet::lsp {

/// True when a control could not tell the blocks apart: the same words, statements, values,
/// comments and faults in the same order. Only their offsets may differ.
bool sameBlock(const Block &a, llvm::StringRef textOfA, const Block &b, llvm::StringRef textOfB);

} // namespace ncvet::lsp
