// Addresses of a control whose name is no letter: `@714`.
#pragma once

#include "formats/dialect/dialect.h"

#include <array>

namespace ncvet {

class IsoSymbols {
public:
  explicit IsoSymbols(const Dialect &dialect);

  /// The address that a character opens; `noAddress`: none. Letters open none here.
  AddressId addressOf(char c) const {
    return uint8_t(c) < addresses_.size() ? addresses_[uint8_t(c)] : noAddress;
  }

private:
  std::array<AddressId, 128> addresses_;
};

} // namespace ncvet
