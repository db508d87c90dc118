// Addresses: the letters (and letter groups) that open a word, as small numbers and sets.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <cstdint>

namespace ncvet {

/// Number of an address: 0..25 are the letters A..Z, then the comma addresses, then the addresses
/// of several letters that a dialect's table names (in its order). Fewer than 64, so that a set of
/// addresses is one machine word.
using AddressId = uint8_t;
using AddressMask = uint64_t;

constexpr AddressId commaA = 26;     ///< `,A`
constexpr AddressId commaC = 27;     ///< `,C`
constexpr AddressId commaR = 28;     ///< `,R`
constexpr AddressId firstNamed = 29; ///< first address of several letters
/// Words that no letters open. They may occur more than once in a block.
constexpr AddressId variableAddress = 60; ///< a value given to a variable: `<ENT=-10>`, `R30=2`
constexpr AddressId argumentAddress = 61; ///< an argument of a call: each in `CYCLE81(50,0,2,-8)`
constexpr AddressId keywordAddress = 62;  ///< a code that is a word of its own: `TRANS`, `<MIR:ON>`
constexpr AddressId noAddress = 63;       ///< a number without an address
constexpr unsigned addressCount = 64;

constexpr AddressId letterAddress(char letter) { return AddressId(letter - 'A'); }
constexpr AddressMask maskOf(AddressId address) { return AddressMask(1) << address; }
constexpr AddressMask addresslessWords =
    maskOf(variableAddress) | maskOf(argumentAddress) | maskOf(keywordAddress);
constexpr AddressMask maskOf(char letter) { return maskOf(letterAddress(letter)); }

/// Mask of plain letters, e.g. `lettersMask("XYZ")`.
constexpr AddressMask lettersMask(const char *letters) {
  AddressMask mask = 0;
  for (; *letters; ++letters)
    mask |= maskOf(*letters);
  return mask;
}

} // namespace ncvet
