// The usual number of a word, read fast, and the dashes that look like its sign.
#pragma once

#include "formats/readers/block.h"

#include <cstdint>

namespace ncvet {

/// More digits than an int64 holds for certain: what is after them is dropped.
constexpr unsigned maxNumberDigits = 18;

inline bool isNumberDigit(char c) { return uint8_t(c - '0') < 10; }

/// Optional minus, digits, perhaps a point and more digits, fewer than `maxNumberDigits` in all,
/// and nothing after it that could belong to a number. Fills in `word` and gives the place after;
/// null, with nothing changed, for every other number. At least one byte must be left. Where commas
/// separate values a comma ends the number.
template <bool commaEnds = false>
inline const char *readPlainNumber(const char *at, const char *end, Word &word) {
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
