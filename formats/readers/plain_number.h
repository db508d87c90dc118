// The usual number of a word, read fast, and the dashes that look like its sign.
#pragma once

#include "formats/readers/block.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace ncvet {

/// More digits than an int64 holds for certain: what is after them is dropped.
constexpr unsigned maxNumberDigits = 18;

inline bool isNumberDigit(char c) { return uint8_t(c - '0') < 10; }

/// Eight decimal digits, one in each byte as its value, the first in the lowest byte.
inline uint32_t eightDigits(uint64_t digits) {
  constexpr uint64_t everyFourth = 0x000000FF000000FF;
  digits = digits * 10 + (digits >> 8); // in every second byte a number of two digits
  return uint32_t(((digits & everyFourth) * 0x000F424000000064 +
                   (digits >> 16 & everyFourth) * 0x0000271000000001) >>
                  32);
}

/// As `readPlainNumber`, for numbers of at most seven digits and a point, which are read all at
/// once; null, with nothing changed, for all others. At least nine bytes must be left.
template <bool commaEnds>
inline const char *readShortNumber(const char *at, Word &word) {
  const bool negative = *at == '-';
  const char *const first = at + negative;
  constexpr uint64_t each = 0x0101010101010101;
  uint64_t bytes;
  std::memcpy(&bytes, first, sizeof bytes);
  bytes ^= each * '0'; // digits become their values
  // The highest bit of each byte that is no digit.
  const uint64_t others = (((bytes & each * 0x7F) + each * 0x76) | bytes) & each * 0x80;
  if (!others)
    return nullptr;
  const unsigned whole = unsigned(std::countr_zero(others)) & ~7u; // bits of the whole part
  const bool hasPoint = uint8_t(bytes >> whole) == ('.' ^ '0');
  unsigned size = whole, decimals = 0; // bits of all digits
  uint64_t digits = bytes;
  if (hasPoint) {
    const uint64_t after = others & (others - 1);
    if (!after)
      return nullptr;
    size = (unsigned(std::countr_zero(after)) & ~7u) - 8;
    decimals = (size - whole) / 8;
    const uint64_t before = (uint64_t(1) << whole) - 1;
    digits = (bytes & before) | (bytes >> 8 & ~before);
  }
  const char *const next = first + size / 8 + hasPoint;
  if (!size || (uint8_t(*next - '+') < 4 && !(commaEnds && *next == ','))) // one of + , - .
    return nullptr;
  const int64_t mantissa = eightDigits(digits << (64 - size));
  word.mantissa = negative ? -mantissa : mantissa;
  word.decimals = uint8_t(decimals);
  word.flags |= uint8_t((hasPoint ? wordPoint : 0) | (negative ? wordMinus : 0) |
                        (whole > 8 && !(bytes & 0xFF) ? wordLeadingZero : 0));
  return next;
}

/// Optional minus, digits, perhaps a point and more digits, fewer than `maxNumberDigits` in all,
/// and nothing after it that could belong to a number. Fills in `word` and gives the place after;
/// null, with nothing changed, for every other number. At least one byte must be left. Where commas
/// separate values a comma ends the number.
template <bool commaEnds = false>
inline const char *readPlainNumber(const char *at, const char *end, Word &word) {
  if (std::endian::native == std::endian::little && end - at > ptrdiff_t(sizeof(uint64_t)))
    if (const char *const after = readShortNumber<commaEnds>(at, word))
      return after;
  const char *p = at;
  const bool negative = *p == '-';
  p += negative;
  const char *const first = p;
  int64_t mantissa = 0;
  // One test per digit suffices: too long a run is refused after the loop, before its value
  // counts.
  const char *const limit = end - p > ptrdiff_t(maxNumberDigits) ? p + maxNumberDigits : end;
  while (p < limit && isNumberDigit(*p))
    mantissa = mantissa * 10 + (*p++ - '0');
  const char *const point = p;
  unsigned decimals = 0;
  bool hasPoint = false;
  if (p < limit && *p == '.') {
    ++p;
    while (p < limit && isNumberDigit(*p))
      mantissa = mantissa * 10 + (*p++ - '0');
    decimals = unsigned(p - point - 1);
    if (point == first && decimals == 0)
      return nullptr;
    hasPoint = true;
  } else if (p == first) {
    return nullptr;
  }
  if (p >= limit || isNumberDigit(*p) || *p == '.' || (*p == ',' && !commaEnds) || *p == '-' ||
      *p == '+')
    return nullptr;
  if (hasPoint)
    word.flags |= wordPoint;
  if (negative)
    word.flags |= wordMinus;
  if (point - first > 1 && *first == '0')
    word.flags |= wordLeadingZero;
  word.mantissa = negative ? -mantissa : mantissa;
  word.decimals = uint8_t(decimals);
  return p;
}

/// Bytes of a dash that looks like a minus in UTF-8: U+2010 to U+2015 and U+2212; 0: none.
inline unsigned typographicMinus(const char *at, const char *end) {
  if (end - at < 3 || uint8_t(at[0]) != 0xE2)
    return 0;
  const auto second = uint8_t(at[1]), third = uint8_t(at[2]);
  const bool dash =
      (second == 0x88 && third == 0x92) || (second == 0x80 && third >= 0x90 && third <= 0x95);
  return dash ? 3 : 0;
}

} // namespace ncvet
