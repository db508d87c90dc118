// Reader of Sinumerik programs: word addresses, words with `=`, statements, calls by name.
#pragma once

#include "formats/readers/reader.h"

namespace ncvet {

class SinumerikReader final : public Reader {
public:
  SinumerikReader(const Dialect &dialect, llvm::StringRef text);
  void read(uint32_t offset, Block &block) const override;

private:
  void markSteps(Block &block) const;

  const Dialect &dialect_;
  llvm::StringMap<AddressId> addresses_; ///< those of several letters, in capitals
  bool steps_ = false; ///< the text is one of ShopMill or ShopTurn: it calls their working steps
};

} // namespace ncvet
