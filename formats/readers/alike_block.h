// Reads a block that is spelled as the one before it, save for its numbers.
#pragma once

#include "formats/readers/block_scanner.h"

#include <array>

namespace ncvet {

/// Longer numbers are left to the reader itself: a control may not take them.
constexpr int64_t mostAlikeNumber = 99'999'999;

/// A grammar's own facts for `readAlike`.
struct AlikeGrammar {
  bool wordsMeet;     ///< a word may follow a number without a blank between them
  bool blanksBelong;  ///< blanks at the end of a line belong to its block
  bool beginsByPoint; ///< `.5` is read like `0.5`
};

/// What a character is to a grammar, in one look.
enum AlikeClass : uint8_t { alikeBlank = 1, alikeLineEnd = 2, alikeLetter = 4 };

template <bool (*Blank)(char)>
inline std::array<uint8_t, 256> makeAlikeClasses() {
  std::array<uint8_t, 256> classes{};
  for (unsigned c = 0; c < classes.size(); ++c)
    classes[c] =
        uint8_t((Blank(char(c)) ? alikeBlank : 0) | (c == '\n' || c == '\r' ? alikeLineEnd : 0) |
                ((c | 32) >= 'a' && (c | 32) <= 'z' && c < 128 ? alikeLetter : 0));
  return classes;
}

/// Whether a block may be the pattern of `readAlike`: plain words alone, perhaps with a number.
inline bool isAlikePattern(const Block &block) {
  return block.kind == BlockKind::Normal && block.skip < 0 && !block.lowerCase &&
         !block.tapeInside && !block.mainBlock && !block.hasLabel() && block.program < 0 &&
         block.headerEnd == 0 && block.nameEnd == 0 && !block.words.empty() &&
         block.items.empty() && block.comments.empty() && block.issues.empty() &&
         block.expressions.empty();
}

/// Reads the block at `offset` over the one that `block` holds, when it has the same words in the
/// same order, each a plain number with a point where that one has a point: of the addresses
/// `free` any number, of the others the same. `block` must be an `isAlikePattern` of this text.
/// False, with nothing of use in `block`: the text is another, or only the reader can tell.
template <bool (*Blank)(char), AlikeGrammar grammar>
bool readAlike(llvm::StringRef text, uint32_t offset, AddressMask free, Block &block) {
  const char *const base = text.begin(), *const end = text.end();
  const char *at = base + offset;
  static const std::array<uint8_t, 256> classes = makeAlikeClasses<Blank>();
  constexpr uint8_t breaks = alikeBlank | alikeLineEnd | (grammar.wordsMeet ? alikeLetter : 0);
  const auto isBreak = [&](const char *p) { return p == end || classes[uint8_t(*p)] & breaks; };
  const auto skipBlanks = [&] {
    while (at < end && classes[uint8_t(*at)] & alikeBlank)
      ++at;
  };
  block.begin = offset;
  skipBlanks();
  if (block.number >= 0) {
    Word number;
    if (end - at < 2 || *at != 'N' || !isNumberDigit(at[1]))
      return false;
    const char *const after = readPlainNumber(at + 1, end, number);
    if (!after || number.has(wordPoint) || number.mantissa > mostAlikeNumber || !isBreak(after))
      return false;
    block.number = number.mantissa;
    block.numberBegin = uint32_t(at - base);
    block.numberEnd = uint32_t(after - base);
    at = after;
    skipBlanks();
  }
  for (Word &word : block.words) {
    // The letter is the same byte as in the text of the pattern.
    if (end - at < 2 || *at != base[word.offset] || word.address != letterAddress(*at) ||
        !(isNumberDigit(at[1]) || at[1] == '-' || (grammar.beginsByPoint && at[1] == '.')))
      return false;
    Word next;
    const char *const after = readPlainNumber(at + 1, end, next);
    constexpr uint8_t usual = wordPoint | wordMinus | wordLeadingZero;
    if (!after || next.mantissa > mostAlikeNumber || next.mantissa < -mostAlikeNumber ||
        (word.flags & ~usual) || ((next.flags ^ word.flags) & wordPoint) ||
        (!(next.flags & wordPoint) && !next.mantissa != !word.mantissa) || !isBreak(after))
      return false;
    if (!(free & maskOf(word.address)) &&
        (next.mantissa != word.mantissa || next.decimals != word.decimals ||
         next.flags != word.flags))
      return false;
    word.flags = next.flags;
    word.decimals = next.decimals;
    word.mantissa = next.mantissa;
    word.offset = uint32_t(at - base);
    word.length = uint8_t(after - at);
    at = after;
    block.end = uint32_t(at - base);
    skipBlanks();
  }
  if (at < end && !isLineEnd(*at))
    return false;
  if (grammar.blanksBelong)
    block.end = uint32_t(at - base);
  if (at < end && *at++ == '\r' && at < end && *at == '\n')
    ++at;
  block.next = uint32_t(at - base);
  return true;
}

} // namespace ncvet
