// JSON Schemas of the tables, made of their records.
#pragma once

#include "formats/dialect/shape.h"

namespace ncvet {

/// The schema of the files whose root is `record`; `name` is that of the schema's own file.
std::string schemaText(const Record &record, llvm::StringRef name);

} // namespace ncvet
