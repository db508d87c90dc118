// Addresses of a control whose name is no letter: `@714`.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/block.h"

#include <array>

namespace ncvet {

class IsoSymbols {
public:
  explicit IsoSymbols(const Dialect &dialect);

  /// The address that a character opens; `noAddress`: none. Letters open none here.
  AddressId addressOf(char c) const {
    return uint8_t(c) < addresses_.size() ? addresses_[uint8_t(c)] : noAddress;
  }

  /// Whether a length has more digits in least increments than the control takes.
  bool isTooLong(const Word &word) const;

private:
  AddressMask lengths_ = 0;   ///< addresses of lengths, where their digits are counted
  double greatestLength_ = 0; ///< in units of the program
  std::array<AddressId, 128> addresses_;
};

} // namespace ncvet
