// Reader of Sinumerik programs: word addresses, words with `=`, statements, calls by name.
#pragma once

#include "formats/readers/reader.h"

namespace ncvet {

class SinumerikReader final : public Reader {
public:
  SinumerikReader(const Dialect &dialect, llvm::StringRef text);
  void read(uint32_t offset, Block &block) const override;

private:
  const Dialect &dialect_;
  llvm::StringMap<AddressId> addresses_; ///< those of several letters, in capitals
};

} // namespace ncvet
