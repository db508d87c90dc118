// Addresses of a control whose name is no letter: which ones its table has.
#include "formats/readers/iso/iso_symbols.h"

#include "formats/dialect/control_facts.h"

#include "llvm/ADT/StringExtras.h"

#include <cmath>

namespace ncvet {

IsoSymbols::IsoSymbols(const Dialect &dialect) {
  if (const unsigned digits = dialect.facts->limits.lengthDigits) {
    constexpr double leastIncrement = 1000; // to a millimetre
    greatestLength_ = std::pow(10, digits) / leastIncrement;
    for (size_t i = 0; i < dialect.addresses.size(); ++i)
      if (dialect.addresses[i].kind == AddressKind::Axis ||
          dialect.addresses[i].kind == AddressKind::Increment)
        lengths_ |= maskOf(AddressId(i));
  }
  addresses_.fill(noAddress);
  for (size_t i = 0; i < dialect.addressNames.size(); ++i)
    // `@n`: the character is the address.
    if (const std::string &name = dialect.addressNames[i]; name.size() == 2 && name[1] == 'n' &&
                                                           uint8_t(name[0]) < addresses_.size() &&
                                                           !llvm::isAlnum(name[0]))
      addresses_[uint8_t(name[0])] = AddressId(firstNamed + i);
}

bool IsoSymbols::isTooLong(const Word &word) const {
  return lengths_ & maskOf(word.address) &&
         (std::fabs(word.value()) >= greatestLength_ ||
          (word.decimals > 3 && std::fabs(double(word.mantissa)) >= 1e9));
}

} // namespace ncvet
