// What the scanners of all readers share: the place in the text, and the block that grows.
#pragma once

#include "formats/readers/block_cursor.h"

#include <algorithm>
#include <utility>

namespace ncvet {

/// Blanks of a line that every control passes over.
inline bool isLineBlank(char c) {
  return c == ' ' || c == '\t' || c == '\0' || c == '\v' || c == '\f';
}

/// The state of reading one block. A reader's scanner derives from it and adds its grammar; `Blank`
/// says which characters stand between words.
template <bool (*Blank)(char) = isLineBlank>
class BlockScanner : protected BlockCursor {
protected:
  using BlockCursor::BlockCursor;

  void skipBlanks() {
    while (at_ < end_ && Blank(*at_))
      ++at_;
  }
  const char *behindBlanks(const char *p) const {
    while (p < end_ && Blank(*p))
      ++p;
    return p;
  }
  bool atLineEnd() const { return at_ == end_ || isLineEnd(*at_); }
  const char *lineEnd() const {
    const char *p = at_;
    while (p < end_ && !isLineEnd(*p))
      ++p;
    return p;
  }
  /// Steps over the end of the line, CR LF as one: the next block begins there.
  void takeLineEnd() {
    if (at_ < end_) {
      const char c = *at_++;
      if (c == '\r' && at_ < end_ && *at_ == '\n')
        ++at_;
    }
    block_.next = offset(at_);
  }

  /// Adds a word whose place is set, and what the block's masks say of it.
  void append(const Word &word) {
    const AddressMask mask = maskOf(word.address);
    block_.words.push_back(word);
    block_.repeated |= block_.addresses & mask;
    block_.addresses |= mask;
    if (word.flags & wordPoint)
      block_.pointed |= mask;
    else if (!(word.flags & (wordExpression | wordNoValue)) && word.mantissa)
      block_.pointless |= mask;
  }
  /// Adds a word that begins at `begin` and ends here.
  void addWord(Word &word, const char *begin) {
    word.offset = offset(begin);
    word.length = lengthFrom(begin);
    append(word);
  }
  /// Characters from `begin` to here, as a word holds them.
  uint8_t lengthFrom(const char *begin) const {
    return uint8_t(std::min<ptrdiff_t>(at_ - begin, 255));
  }

  /// Index of an expression of one operation. A block that holds more than can be counted gets its
  /// last one again.
  uint16_t operation(Op op, const char *begin, const char *end, double value) {
    Expression expression;
    expression.first = uint32_t(block_.operations.size());
    expression.count = 1;
    expression.begin = offset(begin);
    expression.end = offset(end);
    block_.operations.push_back({op, offset(begin), value});
    if (block_.expressions.size() < noExpression - 1)
      block_.expressions.push_back(expression);
    return uint16_t(block_.expressions.size() - 1);
  }
  uint16_t constant(const char *begin, const char *end, double value) {
    return operation(Op::Number, begin, end, value);
  }
  /// A value that no program decides.
  uint16_t opaque(const char *begin, const char *end) {
    return operation(Op::Opaque, begin, end, 0);
  }

  Item itemAt(ItemKind kind, const char *begin) const {
    Item item;
    item.kind = kind;
    item.wordsBefore = uint16_t(block_.words.size());
    item.begin = offset(begin);
    item.firstArgument = uint16_t(block_.arguments.size());
    return item;
  }
  /// Adds an item that ends here.
  void add(Item &item) {
    item.end = offset(at_);
    block_.items.push_back(item);
  }

  /// Index of the expression that `parse`, a member of its parser, reads from here on.
  template <typename Parser, typename... Parameters, typename... Arguments>
  uint16_t parsed(uint16_t (Parser::*parse)(Parameters...), Arguments &&...arguments) {
    Parser parser(*this);
    const uint16_t index = (parser.*parse)(std::forward<Arguments>(arguments)...);
    at_ = parser.position();
    return index;
  }
};

} // namespace ncvet
