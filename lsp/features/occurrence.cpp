// Keys of names: the same for the same name, wherever it is spelled.
#include "lsp/features/occurrence.h"

#include "llvm/Support/xxhash.h"

namespace ncvet::lsp {

uint64_t programKey(llvm::StringRef name) {
  constexpr uint64_t named = uint64_t(1) << 63; // before every number
  return named | llvm::xxHash64(name.upper());
}

uint64_t labelKeyOf(const Reader &reader, llvm::StringRef label) {
  return llvm::xxHash64(reader.labelKey(label));
}

} // namespace ncvet::lsp
