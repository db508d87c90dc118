// Reader of Sinumerik programs: word addresses, words with `=`, statements, calls by name.
#pragma once

#include "formats/readers/quick_reader.h"

namespace ncvet {

class SinumerikReader final : public QuickReader {
public:
  SinumerikReader(const Dialect &dialect, llvm::StringRef text);
  void read(uint32_t offset, Block &block) const override;
  bool isPattern(const Block &block) const override;
  bool readAlike(uint32_t offset, AddressMask free, Block &block) const override;
  EmptyLines emptyLines(uint32_t offset, uint32_t limit) const override;
  bool mayHoldLabels(uint32_t begin, uint32_t end) const override;

private:
  void markSteps(Block &block) const;

  const Dialect &dialect_;
  llvm::StringMap<AddressId> addresses_; ///< those of several letters, in capitals
  bool steps_ = false; ///< the text is one of ShopMill or ShopTurn: it calls their working steps
};

} // namespace ncvet
