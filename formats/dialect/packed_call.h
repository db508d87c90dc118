// The number of a called program where a control packs the count of its runs before it.
#pragma once

#include "formats/dialect/dialect.h"

namespace ncvet {

/// Which program a number after `P` calls, and how often.
struct PackedCall {
  int64_t program = 0;
  int64_t runs = 1;
  unsigned digits = 0; ///< last digits of the number that are the program's; 0: all of them
};

/// `P51000` runs O1000 five times where programs have four digits; `counted`: the block says
/// elsewhere how often the program runs, and the number is the program's alone.
inline PackedCall unpackCall(const Dialect &dialect, int64_t number, bool counted) {
  constexpr unsigned digits = 4;
  constexpr int64_t past = 10000; // the numbers of so many digits
  if (counted || number < past || dialect.limits.programDigitsMax != digits)
    return {number, 1, 0};
  return {number % past, number / past, digits};
}

/// The same where a program with all digits of the number counts first: what the number means when
/// there is none.
inline PackedCall unpackCall(const Dialect &dialect, int64_t number) {
  const unsigned digits = dialect.limits.packedCallDigits;
  int64_t past = 1;
  for (unsigned i = 0; i < digits; ++i)
    past *= 10;
  if (!digits || number < past)
    return {number, 1, 0};
  return {number % past, number / past, digits};
}

} // namespace ncvet
