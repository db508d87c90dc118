// Chooses a reader by the name in the dialect's table.
#pragma once

#include "formats/readers/reader.h"

namespace ncvet {

/// The reader that the dialect's table names, over `text`.
std::unique_ptr<Reader> makeReader(const Dialect &dialect, llvm::StringRef text);

} // namespace ncvet
