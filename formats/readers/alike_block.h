// Reads a block that is spelled as the one before it, save for its numbers.
#pragma once

#include "formats/readers/block_scanner.h"
#include "formats/readers/block_widths.h"

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
constexpr std::array<uint8_t, 256> makeAlikeClasses() {
  std::array<uint8_t, 256> classes{};
  for (unsigned c = 0; c < classes.size(); ++c)
    classes[c] =
        uint8_t((Blank(char(c)) ? alikeBlank : 0) | (c == '\n' || c == '\r' ? alikeLineEnd : 0) |
                ((c | 32) >= 'a' && (c | 32) <= 'z' && c < 128 ? alikeLetter : 0));
  return classes;
}

/// Whether a block may be the pattern of `readAlike`: plain words alone, perhaps with a number
/// before them and a comment after them.
inline bool isAlikePattern(const Block &block) {
  return block.kind == BlockKind::Normal && block.skip < 0 && !block.lowerCase &&
         !block.tapeInside && !block.mainBlock && !block.hasLabel() && block.program < 0 &&
         block.headerEnd == 0 && block.nameEnd == 0 && !block.words.empty() &&
         block.items.empty() && block.issues.empty() && block.expressions.empty() &&
         (block.comments.empty() ||
          (block.comments.size() == 1 && block.comments[0].begin > block.words.back().offset));
}

/// A place in the text at which a block is read over another one.
template <bool (*Blank)(char), AlikeGrammar grammar>
class AlikeCursor {
public:
  AlikeCursor(llvm::StringRef text, uint32_t offset)
      : base_(text.begin()), at_(base_ + offset), end_(text.end()) {}

  void skipBlanks() {
    while (at_ < end_ && classes[uint8_t(*at_)] & alikeBlank)
      ++at_;
  }

  /// The number of the block; false: it has none, or one that is not as usual.
  bool readNumber(Block &block) {
    Word number;
    if (end_ - at_ < 2 || *at_ != 'N' || !isNumberDigit(at_[1]))
      return false;
    const char *const after = readPlainNumber(at_ + 1, end_, number);
    if (!after || number.has(wordPoint) || number.mantissa > mostAlikeNumber || !isBreak(after))
      return false;
    block.number = number.mantissa;
    block.numberBegin = offset(at_);
    block.numberEnd = offset(after);
    at_ = after;
    return true;
  }

  /// A word with another number.
  bool readFree(Word &word) {
    constexpr uint8_t usual = wordPoint | wordMinus | wordLeadingZero;
    // The letter is the same byte as in the text of the pattern.
    if (end_ - at_ < 2 || *at_ != base_[word.offset] || word.address != letterAddress(*at_) ||
        !(isNumberDigit(at_[1]) || at_[1] == '-' || (grammar.beginsByPoint && at_[1] == '.')))
      return false;
    Word next;
    const char *const after = readPlainNumber(at_ + 1, end_, next);
    if (!after || next.mantissa > mostAlikeNumber || next.mantissa < -mostAlikeNumber ||
        (word.flags & ~usual) || ((next.flags ^ word.flags) & (wordPoint | wordLeadingZero)) ||
        (!(next.flags & wordPoint) && !next.mantissa != !word.mantissa) || !isBreak(after))
      return false;
    word.flags = next.flags;
    word.decimals = next.decimals;
    word.mantissa = next.mantissa;
    word.offset = offset(at_);
    word.length = uint8_t(after - at_);
    at_ = after;
    return true;
  }

  /// The same word, spelled in the same bytes.
  bool readSame(Word &word) {
    constexpr uint8_t usual = wordPoint | wordMinus | wordLeadingZero;
    const char *const before = base_ + word.offset;
    if ((word.flags & ~usual) || word.length < 2 || word.length == 255 ||
        word.length > end_ - at_ || word.address != letterAddress(*at_) ||
        !isEqual(before, at_, word.length) || !isBreak(at_ + word.length))
      return false;
    word.offset = offset(at_);
    at_ += word.length;
    return true;
  }

  /// The comment at the end of the block.
  template <typename Find>
  bool readComment(Comment &comment, Find find) {
    const char *const after = at_ < end_ ? find(at_) : at_;
    if (after == at_)
      return false;
    comment.begin = offset(at_);
    comment.end = offset(after);
    at_ = after;
    return true;
  }

  /// The end of the line.
  bool readEnd(Block &block) {
    skipBlanks();
    if (at_ < end_ && !isLineEnd(*at_))
      return false;
    if (grammar.blanksBelong)
      block.end = offset(at_);
    if (at_ < end_ && *at_++ == '\r' && at_ < end_ && *at_ == '\n')
      ++at_;
    block.next = offset(at_);
    return true;
  }

private:
  static constexpr std::array<uint8_t, 256> classes = makeAlikeClasses<Blank>();

  uint32_t offset(const char *p) const { return uint32_t(p - base_); }
  bool isBreak(const char *p) const {
    constexpr uint8_t breaks = alikeBlank | alikeLineEnd | (grammar.wordsMeet ? alikeLetter : 0);
    return p == end_ || classes[uint8_t(*p)] & breaks;
  }
  bool isEqual(const char *a, const char *b, unsigned length) const {
    uint64_t left, right;
    if (std::endian::native != std::endian::little || length > sizeof left ||
        end_ - std::max(a, b) < ptrdiff_t(sizeof left))
      return std::memcmp(a, b, length) == 0;
    std::memcpy(&left, a, sizeof left);
    std::memcpy(&right, b, sizeof right);
    return ((left ^ right) << (64 - 8 * length)) == 0;
  }

  const char *const base_;
  const char *at_;
  const char *const end_;
};

/// Reads the block at `offset` over the one that `block` holds, when it has the same words in the
/// same order, each a plain number with a point where that one has a point: of the addresses
/// `free` any number, of the others the same. `block` must be an `isAlikePattern` of this text.
/// `comment` gives for a place in the text the place after the comment there, or the same place
/// when there is none, or one that may mean something. False: the text is another, or only the
/// reader can tell; `block` then holds no block, but is the same pattern still.
template <bool (*Blank)(char), AlikeGrammar grammar, typename Find>
bool readAlike(llvm::StringRef text, uint32_t offset, AddressMask free, Block &block,
               Find comment) {
  if (readSameLayout(text, offset, free, block) || readOtherWidths(text, offset, free, block))
    return true;
  AlikeCursor<Blank, grammar> cursor(text, offset);
  block.plain = 0;
  block.begin = offset;
  cursor.skipBlanks();
  if (block.number >= 0) {
    if (!cursor.readNumber(block))
      return false;
    cursor.skipBlanks();
  }
  for (Word &word : block.words) {
    if (!(free & maskOf(word.address) ? cursor.readFree(word) : cursor.readSame(word)))
      return false;
    cursor.skipBlanks();
  }
  const Word &last = block.words.back();
  block.end = last.offset + last.length;
  if (!block.comments.empty()) {
    if (!cursor.readComment(block.comments[0], comment))
      return false;
    block.end = block.comments[0].end;
  }
  if (!cursor.readEnd(block))
    return false;
  block.plain = free;
  return true;
}

} // namespace ncvet
