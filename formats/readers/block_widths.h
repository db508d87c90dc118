// Reads a block whose line has the bytes of that of the one before it but for numbers, which may
// have more digits or fewer.
#pragma once

#include "formats/readers/block_layout.h"

#include <algorithm>
#include <utility>

namespace ncvet {

/// A line that is read beside the one before it.
class LineBeside {
public:
  /// `from`: where the block that was read before begins; `at`: where the one to read does.
  LineBeside(llvm::StringRef text, uint32_t from, uint32_t at)
      : base_(text.begin()), from_(base_ + from), at_(base_ + at), end_(text.end()) {}

  uint32_t offset() const { return uint32_t(at_ - base_); }

  /// Goes over the same bytes in both, up to `to` in the old line.
  bool pass(uint32_t to) {
    const char *const until = base_ + to;
    const auto length = unsigned(until - from_);
    if (length > furthest || end_ - std::max(from_, at_) < ptrdiff_t(layoutStep) || !isSame(length))
      return false;
    from_ = until;
    at_ += length;
    return true;
  }
  /// Goes over `length` bytes of the old line, and in the new one over a whole number.
  bool passNumber(uint32_t length, int64_t &number) {
    uint64_t values = 0;
    const unsigned bits = end_ - at_ < ptrdiff_t(layoutStep) ? 0 : digitBits(at_, values);
    if (!bits)
      return false;
    number = eightDigits(values << (64 - bits));
    from_ += length;
    at_ += bits / 8;
    return true;
  }
  /// A word that is the same in both, up to whose begin they were passed.
  bool passSame(Word &word) {
    const uint32_t begin = offset();
    if (!pass(word.offset + word.length))
      return false;
    word.offset = begin;
    return true;
  }
  /// The number of a word whose letter was passed.
  bool passNumber(Word &word) {
    const bool negative = *at_ == '-', hasPoint = word.flags & wordPoint;
    const char *const first = at_ + negative;
    uint64_t values = 0;
    if (end_ - first < ptrdiff_t(layoutStep))
      return false;
    const unsigned whole = digitBits(first, values);
    unsigned bits = whole;
    if (whole > 8 * mostDigits || !whole ||
        (whole > 8 && !(values & 0xFF)) != bool(word.flags & wordLeadingZero))
      return false;
    if (hasPoint) {
      uint64_t after = 0;
      if (first[whole / 8] != '.')
        return false;
      bits += digitBits(first + whole / 8 + 1, after);
      if (bits > 8 * mostDigits)
        return false;
      const uint64_t before = (uint64_t(1) << whole) - 1;
      values = (values & before) | after << whole;
    }
    const int64_t mantissa = eightDigits(values << (64 - bits));
    if (!hasPoint && !mantissa != !word.mantissa)
      return false;
    from_ += word.length - 1;
    word.offset = uint32_t(at_ - base_) - 1;
    at_ = first + bits / 8 + hasPoint;
    word.flags = uint8_t((word.flags & ~wordMinus) | (negative ? wordMinus : 0));
    word.decimals = uint8_t((bits - whole) / 8);
    word.length = uint8_t(offset() - word.offset);
    word.mantissa = negative ? -mantissa : mantissa;
    return true;
  }

private:
  static constexpr unsigned mostDigits = 7;
  /// Longer pieces are left to others.
  static constexpr unsigned furthest = 8;

  bool isSame(unsigned length) const {
    if (!length)
      return true;
    uint64_t left, right;
    std::memcpy(&left, from_, sizeof left);
    std::memcpy(&right, at_, sizeof right);
    return ((left ^ right) << (64 - 8 * length)) == 0;
  }
  /// How many bits the digits at a place take, a byte for each, at most 64; `values` holds theirs
  /// from the lowest byte on.
  static unsigned digitBits(const char *at, uint64_t &values) {
    constexpr uint64_t each = 0x0101010101010101;
    std::memcpy(&values, at, sizeof values);
    values ^= digitZeros;
    // The highest bit of each byte that is no digit.
    const uint64_t others = (((values & each * 0x7F) + each * 0x76) | values) & each * 0x80;
    return unsigned(std::countr_zero(others)) & ~7u;
  }

  const char *const base_, *from_, *at_;
  const char *const end_;
};

/// As `readSameLayout`, where numbers may be of other widths. False: it is another, or only others
/// can tell; the block is then to be read letter by letter.
inline bool readOtherWidths(llvm::StringRef text, uint32_t offset, AddressMask free, Block &block) {
  if (std::endian::native != std::endian::little || !block.plain || (free & ~block.plain) ||
      !block.comments.empty() || text[block.next - 1] != '\n')
    return false;
  const AddressMask plain = std::exchange(block.plain, 0); // until all of it is read
  const Word &last = block.words.back();
  const uint32_t blanks = block.end - last.offset - last.length, next = block.next;
  LineBeside line(text, block.begin, offset);
  if (block.number >= 0) {
    const uint32_t digits = block.numberEnd - block.numberBegin - 1;
    if (!line.pass(block.numberBegin + 1))
      return false;
    block.numberBegin = line.offset() - 1;
    if (!line.passNumber(digits, block.number))
      return false;
    block.numberEnd = line.offset();
  }
  for (Word &word : block.words)
    if (free & maskOf(word.address) ? !line.pass(word.offset + 1) || !line.passNumber(word)
                                    : !line.pass(word.offset) || !line.passSame(word))
      return false;
  block.end = line.offset() + blanks;
  if (!line.pass(next))
    return false;
  block.begin = offset;
  block.next = line.offset();
  block.plain = plain;
  return true;
}

} // namespace ncvet
