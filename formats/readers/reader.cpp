// Chooses a reader by the name in the dialect's table.
#include "formats/readers/reader.h"

#include "formats/readers/iso_reader.h"

namespace ncvet {

std::unique_ptr<Reader> makeReader(const Dialect &dialect, llvm::StringRef text) {
  return std::make_unique<IsoReader>(dialect, text);
}

} // namespace ncvet
