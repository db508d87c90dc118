// The form of a line that was read: what is between its numbers, so that other such lines cost
// their numbers.
#pragma once

#include "formats/readers/block_layout.h"
#include "formats/readers/quick_reader.h"

#include <string>

namespace ncvet {

/// Lines of one form are the same bytes but for the numbers of free words, for the block number,
/// and for the digits in a comment. Such numbers may have any width and sign.
class SpelledLine {
public:
  /// As `QuickReader::readAlike`, with the form of the line that was read so last.
  bool readAlike(const QuickReader &reader, uint32_t offset, AddressMask free, Block &block) {
    return read(reader.text(), offset, block) || readOther(reader, offset, free, block);
  }
  /// The same of a line that is not of this form.
  bool readOther(const QuickReader &reader, uint32_t offset, AddressMask free, Block &block) {
    if (!reader.readAlike(offset, free, block))
      return false;
    if (std::has_single_bit(++misses_)) // perhaps it has numbers that are not for this
      take(reader.text(), block, free);
    return true;
  }
  void forget() {
    parts_.clear();
    misses_ = 0;
  }
  /// Takes the form of a line that was read over another one into `block`.
  void take(llvm::StringRef text, const Block &block, AddressMask free);
  /// Reads the line at `offset` into `block`, which holds one that is spelled alike. False: it has
  /// another form, or none is known; `block` may then be read over still.
  bool read(llvm::StringRef text, uint32_t offset, Block &block);

private:
  enum class After : uint8_t { Nothing, Number, WholeNumber, BlockNumber, Comment };
  /// Some bytes, and what comes after them.
  struct Part {
    uint64_t bytes = 0, mask = 0;
    uint8_t length = 0;
    After after = After::Nothing;
    uint8_t word = 0;    ///< index in `Block::words` of its number
    uint8_t flags = 0;   ///< of the word, without its sign
    bool isZero = false; ///< of a number without a point: it counts as no other one does
    bool leads = false;  ///< its whole part has several digits, the first of them 0
    // How the number before was written, if with a point, as most others are. Bytes of its digits
    // and its point, the first one lowest.
    bool isNegative = false;
    uint8_t ofOneDigit = 0;           ///< not 0: before its point
    uint8_t size = 0;                 ///< with its sign
    uint8_t shift = 0;                ///< brings its digits to the upper end
    Word written;                     ///< it, but for place and number
    uint64_t ends = 1, upToEnd = 0;   ///< what is no digit of these bytes; 1: there was none before
    uint64_t whole = 0, fraction = 0; ///< masks of its digits, the point taken out
  };
  /// A word without a free number: so many bytes after the number before it in the line.
  struct Fixed {
    uint8_t word, after, at;
  };
  static constexpr uint8_t atBegin = 255, atBlockNumber = 254; ///< `after` no other word
  static constexpr unsigned mostDigits = 7;
  static constexpr uint64_t each = 0x0101010101010101;

  /// The values of eight digits.
  static uint64_t load(const char *from) {
    uint64_t bytes;
    std::memcpy(&bytes, from, sizeof bytes);
    return bytes ^ digitZeros;
  }
  /// The highest bit of each byte that is no digit's value.
  static uint64_t noDigits(uint64_t bytes) {
    return (((bytes & each * 0x7F) + each * 0x76) | bytes) & each * 0x80;
  }
  bool takeWords(llvm::StringRef text, const Block &block);
  bool addBytes(llvm::StringRef text, uint32_t begin, uint32_t end);
  static const char *readPointed(const char *at, Part &part, Word &word);
  static const char *readNumber(const char *at, Part &part, Word &word);
  static void keepWidths(const char *at, const Word &word, unsigned whole, Part &part);
  static const char *readBlockNumber(const char *at, int64_t &number);
  const char *readOther(const char *base, const char *at, Part &part, Block &block) const;

  llvm::SmallVector<Part, 8> parts_;  ///< none: no form is known
  llvm::SmallVector<Fixed, 8> fixed_; ///< words without a free number
  std::string comment_;               ///< with so many bytes after it as may be looked at
  uint32_t commentLength_ = 0;
  uint32_t longest_ = 0; ///< that such a line can be, and what is looked at after it
  uint32_t tail_ = 0;    ///< bytes of the line after its block
  AddressMask free_ = 0;
  unsigned misses_ = 0; ///< lines that were not of the form
};

/// The number of a free word that has a point; null: it is none of the form.
inline const char *SpelledLine::readPointed(const char *at, Part &part, Word &word) {
  const uint64_t digits = load(at + part.isNegative);
  // (that it is no digit is the highest bit of a byte: the others of `upToEnd` are 0)
  const uint64_t others = ((digits & each * 0x7F) + each * 0x76) | digits;
  if ((others & part.upToEnd) != part.ends || (part.isNegative && *at != '-') ||
      !uint8_t(digits | part.ofOneDigit) != part.leads)
    return readNumber(at, part, word);
  const int64_t mantissa =
      eightDigits(((digits & part.whole) | (digits >> 8 & part.fraction)) << part.shift);
  const uint32_t offset = word.offset;
  word = part.written;
  word.offset = offset;
  word.mantissa = part.isNegative ? -mantissa : mantissa;
  return at + part.size;
}

/// The number after the N of a block.
inline const char *SpelledLine::readBlockNumber(const char *at, int64_t &number) {
  const uint64_t digits = load(at);
  const unsigned bits = unsigned(std::countr_zero(noDigits(digits))) & ~7u;
  if (!bits)
    return nullptr;
  number = eightDigits(digits << (64 - bits));
  return at + bits / 8;
}

/// What comes after a part that is no number with a point; null: it is none of the form.
inline const char *SpelledLine::readOther(const char *base, const char *at, Part &part,
                                          Block &block) const {
  block.plain = 0;
  if (part.after == After::WholeNumber) {
    Word &word = block.words[part.word];
    word.offset = uint32_t(at - base) - 1;
    return readNumber(at, part, word);
  }
  if (part.after == After::BlockNumber) {
    block.numberBegin = uint32_t(at - base) - 1;
    at = readBlockNumber(at, block.number);
    block.numberEnd = uint32_t(at - base);
    return at;
  }
  if (!haveSameLayout(comment_.data(), at, commentLength_))
    return nullptr;
  block.comments[0].begin = uint32_t(at - base);
  block.comments[0].end = block.comments[0].begin + commentLength_;
  return at + commentLength_;
}

inline bool SpelledLine::read(llvm::StringRef text, uint32_t offset, Block &block) {
  const char *const base = text.begin(), *at = base + offset;
  if (parts_.empty() || text.end() - at < ptrdiff_t(longest_))
    return false;
  for (Part &part : parts_) {
    uint64_t bytes;
    std::memcpy(&bytes, at, sizeof bytes);
    if ((bytes ^ part.bytes) & part.mask)
      return false;
    at += part.length;
    if (part.after == After::Number) {
      block.plain = 0; // until all of it is read
      Word &word = block.words[part.word];
      word.offset = uint32_t(at - base) - 1;
      at = readPointed(at, part, word);
    } else if (part.after != After::Nothing) {
      at = readOther(base, at, part, block);
    }
    if (!at)
      return false;
  }
  for (const auto &[word, after, place] : fixed_) {
    const Word &before = block.words[after < atBlockNumber ? after : 0];
    const uint32_t from = after < atBlockNumber ? before.offset + before.length
                          : after == atBegin    ? offset
                                                : block.numberEnd;
    block.words[word].offset = from + place;
  }
  block.begin = offset;
  block.next = uint32_t(at - base);
  block.end = block.next - tail_;
  block.plain = free_;
  return true;
}

} // namespace ncvet
