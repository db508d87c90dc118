// Finds the codes of a table in a block, and the words that their formats name.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/block.h"

namespace ncvet {

/// The code that a word is, without its variants; `noCode` for other words and unknown codes.
CodeIndex codeOf(const Dialect &dialect, const Word &word);

/// The word of the block's last assignment to the variable with this key, or null.
const Word *assignmentOf(const Block &block, uint64_t variable);
/// The word of the block that `spec` speaks of: by its address, its place among the arguments, or
/// the variable that it sets. Null when there is none; an argument left empty counts as none.
const Word *wordFor(const Block &block, const WordSpec &spec);

} // namespace ncvet
