// Addresses of a control whose name is no letter: which ones its table has.
#include "formats/readers/iso/iso_symbols.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

IsoSymbols::IsoSymbols(const Dialect &dialect) {
  addresses_.fill(noAddress);
  for (size_t i = 0; i < dialect.addressNames.size(); ++i)
    // `@n`: the character is the address.
    if (const std::string &name = dialect.addressNames[i]; name.size() == 2 && name[1] == 'n' &&
                                                           uint8_t(name[0]) < addresses_.size() &&
                                                           !llvm::isAlnum(name[0]))
      addresses_[uint8_t(name[0])] = AddressId(firstNamed + i);
}

} // namespace ncvet
