// Reader of word-address programs (ISO 6983, DIN 66025): FANUC, Haas, NCT and their kin.
#pragma once

#include "formats/readers/iso/iso_symbols.h"
#include "formats/readers/quick_reader.h"

namespace ncvet {

class IsoReader final : public QuickReader {
public:
  IsoReader(const Dialect &dialect, llvm::StringRef text);
  void read(uint32_t offset, Block &block) const override;
  bool isPattern(const Block &block) const override;
  bool readAlike(uint32_t offset, AddressMask free, Block &block) const override;
  EmptyLines emptyLines(uint32_t offset, uint32_t limit) const override;
  std::string labelKey(llvm::StringRef label) const override;

private:
  bool maySay(const Block &block) const;

  const Lexical &lexical_;
  IsoSymbols symbols_;
};

} // namespace ncvet
