// Reader of word-address programs (ISO 6983, DIN 66025): FANUC, Haas, NCT and their kin.
#pragma once

#include "formats/readers/reader.h"

#include <array>

namespace ncvet {

class IsoReader final : public Reader {
public:
  IsoReader(const Dialect &dialect, llvm::StringRef text);
  void read(uint32_t offset, Block &block) const override;
  std::string labelKey(llvm::StringRef label) const override;

  /// Address that a character opens which is no letter: `@`; `noAddress`: none.
  using Symbols = std::array<AddressId, 128>;

private:
  const Lexical &lexical_;
  Symbols symbols_;
};

} // namespace ncvet
