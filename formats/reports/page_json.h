// JSON inside a page, and arrays of numbers inside JSON.
#pragma once

#include "llvm/ADT/StringRef.h"
#include "llvm/Support/Endian.h"
#include "llvm/Support/raw_ostream.h"

#include <string>

namespace ncvet {

/// Numbers as bytes, the least significant first: what `Uint32Array` and its like read.
class NumberBytes {
public:
  template <typename T>
  void add(T value) {
    char bytes[sizeof(T)];
    llvm::support::endian::write<T, llvm::support::little, llvm::support::unaligned>(bytes, value);
    bytes_.append(bytes, sizeof(T));
  }
  /// In groups of seven bits, the least significant first; all but the last with the eighth bit.
  void addShort(uint32_t value);
  std::string base64() const;

private:
  std::string bytes_;
};

/// Writes JSON so that no HTML parser sees a tag in it: `<` only occurs in strings of JSON.
void writeJsonInPage(llvm::StringRef json, llvm::raw_ostream &out);

} // namespace ncvet
