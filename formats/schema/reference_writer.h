// The reference of the tables for readers, made of their records.
#pragma once

#include "formats/dialect/shape.h"

namespace ncvet {

/// Markdown: each record with a table of its keys, then the vocabularies.
std::string referenceText(llvm::ArrayRef<const Record *> roots);

} // namespace ncvet
