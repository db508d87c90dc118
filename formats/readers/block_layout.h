// Reads a block whose line differs from that of the one before it in digits only.
#pragma once

#include "formats/readers/plain_number.h"

#if defined(__SSE2__) // part of every x86-64
#include <emmintrin.h>
#endif

namespace ncvet {

/// So many bytes of two lines are compared at once, and as many may be looked at after their ends.
constexpr uint32_t layoutStep = 16;

constexpr uint64_t digitZeros = 0x3030303030303030; ///< eight digits 0

/// Whether `layoutStep` bytes are the same from the first one on but for their digits: a bit for
/// each byte.
inline unsigned sameButDigits(const char *a, const char *b) {
#if defined(__SSE2__)
  const auto load = [](const char *from) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i *>(from));
  };
  const auto isDigit = [](__m128i text) {
    const __m128i values = _mm_sub_epi8(text, _mm_set1_epi8('0'));
    return _mm_cmpeq_epi8(_mm_min_epu8(values, _mm_set1_epi8(9)), values);
  };
  const __m128i left = load(a), right = load(b);
  const __m128i digits = _mm_and_si128(isDigit(left), isDigit(right));
  const __m128i others = _mm_andnot_si128(digits, _mm_xor_si128(left, right));
  return unsigned(_mm_movemask_epi8(_mm_cmpeq_epi8(others, _mm_setzero_si128())));
#else
  unsigned same = 0;
  for (uint32_t i = 0; i < layoutStep; ++i)
    same |= unsigned(a[i] == b[i] || (isNumberDigit(a[i]) && isNumberDigit(b[i]))) << i;
  return same;
#endif
}

/// The same of whole lines of `length` bytes, 1 at least.
inline bool haveSameLayout(const char *a, const char *b, uint32_t length) {
  for (; length > layoutStep; length -= layoutStep, a += layoutStep, b += layoutStep)
    if (sameButDigits(a, b) != (1u << layoutStep) - 1)
      return false;
  return unsigned(std::countr_one(sameButDigits(a, b))) >= length;
}

/// The number of so many digits, one to eight.
inline uint32_t digitsAt(const char *first, unsigned digits) {
  uint64_t values;
  std::memcpy(&values, first, sizeof values);
  return eightDigits((values ^ digitZeros) << (64 - 8 * digits));
}

/// Whether the word is the same in both lines.
inline bool haveSameWord(const char *a, const char *b, unsigned length) {
  uint64_t left, right;
  if (length > sizeof left)
    return std::memcmp(a, b, length) == 0;
  std::memcpy(&left, a, sizeof left);
  std::memcpy(&right, b, sizeof right);
  return ((left ^ right) << (64 - 8 * length)) == 0;
}

/// Puts the number at `letter` into `word`, whose number has its sign, its digits and its point at
/// the same places. False: it is too long, or the block would have another meaning.
inline bool readDigits(const char *letter, Word &word) {
  constexpr unsigned mostDigits = 7;
  const bool negative = word.flags & wordMinus, hasPoint = word.flags & wordPoint;
  const unsigned digits = word.length - 1u - negative - hasPoint;
  if (digits > mostDigits)
    return false;
  const unsigned whole = digits - word.decimals; // before the point
  uint64_t values;
  std::memcpy(&values, letter + 1 + negative, sizeof values);
  values ^= digitZeros;
  const uint64_t before = (uint64_t(1) << 8 * whole) - 1;
  const uint64_t all = (values & before) | (values >> 8 * unsigned(hasPoint) & ~before);
  const int64_t mantissa = eightDigits(all << (64 - 8 * digits));
  if ((whole > 1 && !(values & 0xFF)) != bool(word.flags & wordLeadingZero) ||
      (!hasPoint && !mantissa != !word.mantissa))
    return false;
  word.mantissa = negative ? -mantissa : mantissa;
  return true;
}

/// As `readAlike`, of a block that was read over another one, and whose line has the bytes of the
/// one at `offset` but for digits. False: it is another; `block` may have some of its numbers then,
/// and is the same pattern still.
inline bool readSameLayout(llvm::StringRef text, uint32_t offset, AddressMask free, Block &block) {
  constexpr unsigned mostDigits = 8;
  const uint32_t length = block.next - block.begin;
  const auto by = ptrdiff_t(offset) - ptrdiff_t(block.begin); // or back
  const char *const line = text.begin() + offset, *const before = text.begin() + block.begin;
  if (std::endian::native != std::endian::little || !block.plain || (free & ~block.plain) ||
      text.end() - std::max(line, before) < ptrdiff_t(length + layoutStep) ||
      before[length - 1] != '\n' || !haveSameLayout(before, line, length))
    return false;
  const bool hasNumber = block.number >= 0;
  if (hasNumber && block.numberEnd - block.numberBegin > 1 + mostDigits)
    return false;
  Word *const first = block.words.begin(), *const end = block.words.end();
  for (Word *word = first; word != end; ++word) {
    const char *const at = text.begin() + word->offset;
    word->offset += uint32_t(by);
    if (free & maskOf(word->address) ? readDigits(at + by, *word)
                                     : haveSameWord(at, at + by, word->length))
      continue;
    do // the pattern is in the text where it was
      word->offset -= uint32_t(by);
    while (word-- != first);
    return false;
  }
  if (hasNumber) {
    block.numberBegin += uint32_t(by);
    block.numberEnd += uint32_t(by);
    block.number =
        digitsAt(text.begin() + block.numberBegin + 1, block.numberEnd - block.numberBegin - 1);
  }
  for (Comment &comment : block.comments) {
    comment.begin += uint32_t(by);
    comment.end += uint32_t(by);
  }
  block.begin += uint32_t(by);
  block.end += uint32_t(by);
  block.next += uint32_t(by);
  return true;
}

} // namespace ncvet
