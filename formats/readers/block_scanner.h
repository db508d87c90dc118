// What the scanners of all readers share: the place in the text, and the block that grows.
#pragma once

#include "formats/readers/block_cursor.h"
#include "formats/readers/plain_number.h"

#include <algorithm>
#include <utility>

namespace ncvet {

/// Blanks of a line that every control passes over.
constexpr bool isLineBlank(char c) {
  // DC1 to DC4 start and stop a serial line, and no control reads them.
  return c == ' ' || c == '\t' || c == '\0' || c == '\v' || c == '\f' ||
         (c >= '\x11' && c <= '\x14');
}

/// A letter of an address.
inline bool isLetter(char c) { return uint8_t((c | 32) - 'a') < 26; }

/// Larger block numbers are cut.
constexpr int64_t maxBlockNumber = 1'000'000'000'000;

/// The state of reading one block. A reader's scanner derives from it and adds its grammar; `Blank`
/// says which characters are between words.
template <bool (*Blank)(char) = isLineBlank>
class BlockScanner : protected BlockCursor {
protected:
  using BlockCursor::BlockCursor;

  void skipBlanks() {
    while (at_ < end_ && Blank(*at_))
      ++at_;
  }
  const char *afterBlanks(const char *p) const {
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

  /// Digits as a whole number; larger ones than `most` become it.
  int64_t takeWhole(int64_t most = maxBlockNumber) {
    int64_t number = 0;
    for (; at_ < end_ && isNumberDigit(*at_); ++at_)
      if (number < most)
        number = number * 10 + (*at_ - '0');
    return std::min(number, most);
  }
  /// What was read from `begin` to here is the block's number.
  void setNumber(const char *begin, int64_t number) {
    block_.number = number;
    block_.numberBegin = offset(begin);
    block_.numberEnd = offset(at_);
  }

  /// The sign of a number that is not as usual, perhaps a dash of a word processor; whether it is
  /// a minus.
  bool takeSignMark(Word &word) {
    if (const unsigned bytes = typographicMinus(at_, end_)) {
      issue(SyntaxIssueKind::TypographicMinus, at_, at_ + bytes);
      at_ += bytes;
      word.flags |= wordMinus;
    } else if (*at_ == '-' || *at_ == '+') {
      word.flags |= *at_++ == '-' ? wordMinus : wordPlus;
    }
    return word.has(wordMinus);
  }
  /// Steps over blanks between a sign and its number. `begin` is the word's begin.
  void takeBlanksAfterSign(const char *begin, bool allowed = false) {
    const char *const digits = afterBlanks(at_);
    if (digits == at_ || digits == end_ || (!isNumberDigit(*digits) && *digits != '.'))
      return;
    if (!allowed)
      issue(SyntaxIssueKind::BlankInNumber, begin, digits + 1);
    at_ = digits;
  }
  /// The sign with the blanks after it, which a dash of a word processor may not have; whether it
  /// is a minus. `begin` is the word's begin.
  bool takeSign(Word &word, const char *begin) {
    const bool plain = *at_ == '-' || *at_ == '+';
    const bool negative = takeSignMark(word);
    if (plain)
      takeBlanksAfterSign(begin);
    return negative;
  }
  /// Its digits, of which more than a mantissa holds are dropped, and its point, perhaps a comma
  /// (`leadingComma`: also before all digits); false, with an issue, when there is no digit.
  bool takeDigits(Word &word, const char *begin, bool negative, bool leadingComma) {
    int64_t mantissa = 0;
    unsigned digits = 0, whole = 0, decimals = 0, read = 0;
    const auto take = [&](unsigned &counted) {
      for (; at_ < end_ && isNumberDigit(*at_); ++at_, ++read)
        if (digits < maxNumberDigits) {
          mantissa = mantissa * 10 + (*at_ - '0');
          digits += mantissa != 0;
          ++counted;
        } else {
          word.flags |= wordMalformed;
        }
    };
    take(whole);
    const bool comma =
        at_ + 1 < end_ && *at_ == ',' && isNumberDigit(at_[1]) && (read || leadingComma);
    if (comma || (at_ < end_ && *at_ == '.')) {
      ++at_;
      word.flags |= wordPoint;
      take(decimals);
      decimals = std::min(decimals, maxNumberDigits);
      if (comma)
        issue(SyntaxIssueKind::DecimalComma, begin, at_);
    }
    if (!read) {
      issue(SyntaxIssueKind::MalformedNumber, begin, at_);
      return false;
    }
    word.mantissa = negative ? -mantissa : mantissa;
    word.decimals = uint8_t(decimals);
    return true;
  }
  /// A second point or sign after it, and what follows of the like: an issue; whether there was
  /// one.
  bool takeExcess(Word &word, const char *begin) {
    if (at_ == end_ || (*at_ != '.' && *at_ != '-' && *at_ != '+'))
      return false;
    skipNumberCharacters();
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
    word.flags |= wordMalformed;
    return true;
  }
  void skipNumberCharacters() {
    while (at_ < end_ && (*at_ == '.' || *at_ == '-' || *at_ == '+' || isNumberDigit(*at_)))
      ++at_;
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
  /// The name that an item gives: of a program, an instruction, a variable.
  void nameItem(Item &item, llvm::StringRef name) const {
    item.nameBegin = offset(name.begin());
    item.nameEnd = offset(name.end());
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
