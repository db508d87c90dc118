// Reader of word-address programs (ISO 6983, DIN 66025): FANUC, Haas, NCT and their kin.
#pragma once

#include "formats/readers/iso/iso_symbols.h"
#include "formats/readers/reader.h"

namespace ncvet {

class IsoReader final : public Reader {
public:
  IsoReader(const Dialect &dialect, llvm::StringRef text);
  void read(uint32_t offset, Block &block) const override;
  std::string labelKey(llvm::StringRef label) const override;

private:
  const Lexical &lexical_;
  IsoSymbols symbols_;
};

} // namespace ncvet
