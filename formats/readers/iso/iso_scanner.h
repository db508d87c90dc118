// The state of reading one word-address block, and the grammar of its parts.
#pragma once

#include "formats/dialect/dialect.h"
#include "formats/readers/block_scanner.h"
#include "formats/readers/iso/iso_symbols.h"
#include "formats/readers/iso/macro_expression.h"

#include "llvm/ADT/SmallString.h"

#include <optional>
#include <string>

namespace ncvet {

/// A label of an O-word in the one form of all its spellings.
std::string isoFlowLabel(llvm::StringRef label);

/// Reads one block. Each part of the grammar has a file of its own.
class IsoScanner : BlockScanner<> {
public:
  IsoScanner(const Lexical &lexical, const IsoSymbols &symbols, llvm::StringRef text,
             uint32_t offset, Block &block)
      : BlockScanner(text, offset, block), lexical_(lexical), symbols_(symbols) {}

  void scan();

private:
  bool startsBlock() const { return block_.words.empty() && block_.items.empty(); }
  uint16_t expression(MacroExpression::Form form) {
    return parsed(&MacroExpression::parse, form, lexical_.arithmetic);
  }
  uint16_t operand() { return expression(MacroExpression::Form::Operand); }

  // iso_reader.cpp
  void scanLetter();
  void scanOther();
  bool scanMark();
  bool scanBracket();
  bool scanSkip();
  bool scanEndOfFile();
  void scanStray();

  // iso_words.cpp
  bool scanUnknownWord();
  bool scanIndexed();
  void scanUnusualValue(AddressId address, const char *begin);
  bool opensExpression(const char *p) const;
  bool signsExpression() const;
  void passBareArithmetic(const char *begin);
  bool opensOperand(const char *p) const;
  void scanComma();

  // iso_numbers.cpp
  bool scanNumber(Word &word, const char *begin);
  bool takeSign(Word &word, const char *begin);
  struct Mantissa;
  bool takeWholePart(Word &word, Mantissa &mantissa);
  bool takeFraction(Word &word, const char *begin, Mantissa &mantissa);
  /// `,15`: a decimal comma.
  bool commaFraction() const { return at_ + 1 < end_ && *at_ == ',' && isNumberDigit(at_[1]); }
  void passBlanksInNumber();
  bool numberFollows() const {
    return at_ < end_ && (isNumberDigit(*at_) || *at_ == '-' || *at_ == '+' || *at_ == '.' ||
                          typographicMinus(at_, end_));
  }

  // iso_header.cpp
  void scanTape();
  void scanHeader(const char *begin);
  bool scanName(const char *begin, const char *mark);

  // iso_comments.cpp
  void scanComment();
  void scanNestedComment(const char *begin, const char *inner, const char *close);
  void scanLineComment();
  void scanAbort(const char *begin);
  void nameCallee(const char *begin);

  // iso_macro.cpp
  bool isKeyword(llvm::StringRef word) const {
    return llvm::StringRef(at_, size_t(end_ - at_)).startswith_insensitive(word);
  }
  bool takeKeyword(llvm::StringRef word);
  bool takeShort(llvm::StringRef word);
  bool isMistypedRapid() const;
  uint8_t loopNumber();
  bool scanStatement();
  bool scanIf();
  bool passComparison();
  void spoil(uint16_t condition, const char *begin);
  bool scanThen();
  bool scanGoto();
  bool scanWhile();
  bool scanLoopMark(llvm::StringRef keyword, ItemKind kind);
  bool scanOutputWord(llvm::StringRef keyword);
  bool scanOutputLine(llvm::StringRef keyword);
  void scanAssignment();
  bool opensNamedVariable() const {
    return lexical_.arithmetic == Arithmetic::MacroB30 && end_ - at_ > 2 && at_[1] == '#' &&
           (at_[2] == '_' || isLetter(at_[2]));
  }
  void scanNamedVariable();

  // iso_flow.cpp
  void scanFlowWord();
  std::optional<llvm::StringRef> scanFlowName(Item &item);
  llvm::SmallString<12> takeFlowKeyword();
  void numberedHeader(const char *begin, llvm::StringRef name);
  void scanFlowValue(Item &item);
  uint16_t bracketIfAny();
  void scanCallArguments(Item &item);
  bool scanForeignIf();
  void scanAfterFlowWord();

  // Here because they are all that most words need: they become part of the loop over the block.
  void scanWord(AddressId address, const char *begin);
  bool scanPlainNumber(Word &word);
  bool continuesAfterBlanks(const char *p) const;
  void addNumber(Word &word, const char *begin);
  bool numbersBlock(const Word &word, const char *begin);

  const Lexical &lexical_;
  const IsoSymbols &symbols_;
};

/// The number or expression after an address.
inline void IsoScanner::scanWord(AddressId address, const char *begin) {
  if (at_ < end_ && (isNumberDigit(*at_) || *at_ == '-')) {
    Word word;
    word.address = address;
    word.offset = offset(begin);
    if (scanPlainNumber(word))
      return addNumber(word, begin);
  }
  scanUnusualValue(address, begin);
}

/// Where blanks may be inside numbers: whether there are some, and a digit or point after them.
inline bool IsoScanner::continuesAfterBlanks(const char *p) const {
  if (!lexical_.freeNumbers || p >= end_ || !isLineBlank(*p))
    return false;
  p = afterBlanks(p);
  return p < end_ && (isNumberDigit(*p) || *p == '.');
}

/// The usual number; false, with nothing read, for every other one.
inline bool IsoScanner::scanPlainNumber(Word &word) {
  const Word before = word;
  const char *const after = readPlainNumber(at_, end_, word);
  if (!after)
    return false;
  if (continuesAfterBlanks(after)) {
    word = before;
    return false;
  }
  at_ = after;
  return true;
}

/// Adds a word whose number ends here, or takes it as the number of the block.
inline void IsoScanner::addNumber(Word &word, const char *begin) {
  word.length = lengthFrom(begin);
  if (word.address == letterAddress('N') && numbersBlock(word, begin))
    return;
  constexpr int64_t eightDigits = 99999999;
  if ((word.mantissa > eightDigits || word.mantissa < -eightDigits) && symbols_.isTooLong(word))
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  if (word.has(wordMinus) && (maskOf('G') | maskOf('M')) & maskOf(word.address))
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  append(word);
}

inline bool IsoScanner::numbersBlock(const Word &word, const char *begin) {
  const bool first = startsBlock() && (!lexical_.flowWords || block_.comments.empty());
  if (block_.number < 0 && word.isNumber() && first) {
    setNumber(begin, word.mantissa);
    if (word.has(wordPoint) && !lexical_.freeNumbers)
      issue(SyntaxIssueKind::MalformedNumber, begin, at_);
    return true;
  }
  if (lexical_.flowWords) // (LinuxCNC 2.9, section 11.4.2.2)
    issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
  return false;
}

} // namespace ncvet
