// Finds out the form of a line.
#include "formats/readers/spelled_line.h"

namespace ncvet {

void SpelledLine::take(llvm::StringRef text, const Block &block, AddressMask free) {
  parts_.clear();
  fixed_.clear();
  commentLength_ = 0;
  free_ = free;
  if (std::endian::native != std::endian::little || !block.plain || (free & ~block.plain) ||
      block.comments.size() > 1 || text[block.next - 1] != '\n' || !takeWords(text, block)) {
    parts_.clear();
    return;
  }
  tail_ = block.next - block.end;
  longest_ = commentLength_ + 2 * layoutStep;
  for (const Part &part : parts_)
    longest_ += part.length + 2 + mostDigits; // with a sign and a point
}

/// False: it has no form.
bool SpelledLine::takeWords(llvm::StringRef text, const Block &block) {
  constexpr uint8_t usual = wordPoint | wordMinus | wordLeadingZero;
  constexpr size_t mostWords = 64;
  uint32_t at = block.begin;
  uint8_t after = atBegin;
  if (block.words.size() > mostWords)
    return false;
  if (block.number >= 0) {
    if (!addBytes(text, at, block.numberBegin + 1))
      return false;
    parts_.back().after = After::BlockNumber;
    at = block.numberEnd;
    after = atBlockNumber;
  }
  for (size_t i = 0; i < block.words.size(); ++i) {
    const Word &word = block.words[i];
    if ((word.flags & ~usual) || word.length < 2 || word.length == 255)
      return false;
    if (!(free_ & maskOf(word.address))) {
      if (word.offset < at || word.offset - at > 255)
        return false;
      fixed_.push_back({uint8_t(i), after, uint8_t(word.offset - at)});
      continue;
    }
    if (!addBytes(text, at, word.offset + 1))
      return false;
    Part &part = parts_.back();
    part.after = word.has(wordPoint) ? After::Number : After::WholeNumber;
    part.word = uint8_t(i);
    part.flags = uint8_t(word.flags & ~wordMinus);
    part.isZero = word.mantissa == 0;
    part.leads = word.has(wordLeadingZero);
    at = word.offset + word.length;
    after = uint8_t(i);
  }
  for (const Comment &comment : block.comments) {
    if (!addBytes(text, at, comment.begin))
      return false;
    parts_.back().after = After::Comment;
    commentLength_ = comment.end - comment.begin;
    comment_.assign(text.data() + comment.begin, commentLength_);
    comment_.append(layoutStep, ' ');
    at = comment.end;
  }
  return addBytes(text, at, block.next);
}

/// The number of a free word, of any width; null: it is none of the form.
const char *SpelledLine::readNumber(const char *at, Part &part, Word &word) {
  const bool negative = *at == '-', hasPoint = part.flags & wordPoint;
  const char *const first = at + negative;
  uint64_t digits = load(first);
  const unsigned whole = unsigned(std::countr_zero(noDigits(digits))) & ~7u; // bits of digits
  if (!whole || whole > 8 * mostDigits ||
      (whole > 8 && !(digits & 0xFF)) != bool(part.flags & wordLeadingZero))
    return nullptr;
  unsigned size = whole;
  if (hasPoint) {
    if (first[whole / 8] != '.')
      return nullptr;
    const uint64_t after = load(first + whole / 8 + 1);
    size += unsigned(std::countr_zero(noDigits(after))) & ~7u;
    if (size > 8 * mostDigits)
      return nullptr;
    digits = (digits & ((uint64_t(1) << whole) - 1)) | after << whole;
  }
  const int64_t mantissa = eightDigits(digits << (64 - size));
  if (!hasPoint && !mantissa != part.isZero)
    return nullptr;
  const char *const next = first + size / 8 + hasPoint;
  word.flags = uint8_t(part.flags | (negative ? wordMinus : 0));
  word.decimals = uint8_t((size - whole) / 8);
  word.length = uint8_t(next - at + 1);
  word.mantissa = negative ? -mantissa : mantissa;
  if (hasPoint)
    keepWidths(at, word, whole, part);
  return next;
}

/// The next number at this place is likely to be as wide. `whole`: bits of its digits before the
/// point.
void SpelledLine::keepWidths(const char *at, const Word &word, unsigned whole, Part &part) {
  const unsigned digits = whole + 8 * word.decimals;
  part.isNegative = *at == '-';
  part.ofOneDigit = whole == 8;
  part.size = uint8_t(word.length - 1);
  part.shift = uint8_t(64 - digits);
  part.written = word;
  // The byte after it, where it is one of the eight.
  const uint64_t next = digits + 8 < 64 ? uint64_t(0x80) << (digits + 8) : 0;
  part.ends = uint64_t(0x80) << whole | next;
  part.upToEnd = each * 0x80 & (next ? (next << 1) - 1 : ~uint64_t(0));
  part.whole = (uint64_t(1) << whole) - 1;
  part.fraction = ~part.whole;
}

/// The bytes between two numbers; false: there are none.
bool SpelledLine::addBytes(llvm::StringRef text, uint32_t begin, uint32_t end) {
  constexpr size_t mostParts = 64;
  if (begin >= end)
    return false;
  while (begin < end) {
    Part &part = parts_.emplace_back();
    part.length = uint8_t(std::min<uint32_t>(end - begin, sizeof part.bytes));
    std::memcpy(&part.bytes, text.data() + begin, part.length);
    part.mask = ~uint64_t(0) >> (64 - 8 * part.length);
    begin += part.length;
  }
  return parts_.size() <= mostParts;
}

} // namespace ncvet
