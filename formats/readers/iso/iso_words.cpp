// Words of word-address blocks whose value is no plain number.
#include "formats/readers/iso/iso_scanner.h"

namespace ncvet {

/// Three letters and more in a row are no addresses: one issue for all of it. Bare axis letters,
/// which a reference return may name together, are left alone.
bool IsoScanner::scanUnknownWord() {
  const char *const begin = at_;
  const char *p = at_;
  bool axes = true;
  while (p < end_ && isLetter(*p))
    axes &= llvm::StringRef("XYZABCUVW").contains(char(*p++ & ~32));
  if (p - begin < 3 || axes)
    return false;
  // `XABS[-3]`: the name of a function is directly after the address.
  if (opensExpression(begin + 1) &&
      MacroExpression::namesFunction({begin + 1, size_t(p - begin - 1)}))
    return false;
  while (p < end_ && (isLetter(*p) || isNumberDigit(*p) || *p == '_'))
    ++p;
  at_ = p;
  issue(SyntaxIssueKind::UnknownWord, begin, p);
  return true;
}

/// `X1=10.`, `XA2=5.`, `S2=500`: an axis or a spindle whose name has an index. False, with nothing
/// read: it is none. An axis of such a name is none that is followed: its value is passed over.
bool IsoScanner::scanIndexed() {
  constexpr ptrdiff_t mostLetters = 2, mostDigits = 2;
  const char *const begin = at_;
  const char *p = begin;
  while (p < end_ && isLetter(*p) && p - begin < mostLetters)
    ++p;
  const char *const index = p;
  while (p < end_ && isNumberDigit(*p) && p - index < mostDigits)
    ++p;
  if (p == index || p >= end_ || *p != '=' ||
      !llvm::StringRef("XYZABCUVWS").contains(char(*begin & ~32)))
    return false;
  at_ = p + 1;
  if ((*begin & ~32) == 'S' && index == begin + 1) {
    scanWord(letterAddress('S'), begin);
    return true;
  }
  Word ignored;
  if (numberFollows() && !signsExpression())
    scanNumber(ignored, begin);
  else if (at_ < end_ && (opensExpression(at_) || *at_ == '-' || *at_ == '+'))
    operand();
  return true;
}

/// A variable, a bracket, or a function where it may be without brackets around it: `XSIN[30]`.
bool IsoScanner::opensExpression(const char *p) const {
  if (p < end_ && (*p == '#' || *p == '['))
    return true;
  if (lexical_.arithmetic != Arithmetic::Ngc)
    return false;
  const char *const name = p;
  while (p < end_ && isLetter(*p))
    ++p;
  return p - name > 1 && afterBlanks(p) < end_ && *afterBlanks(p) == '[';
}

/// Whether the signs that are here belong to an expression.
bool IsoScanner::signsExpression() const {
  if (!lexical_.macro)
    return false;
  const bool several = lexical_.arithmetic == Arithmetic::Ngc;
  const auto isSign = [](char c) { return c == '-' || c == '+'; };
  unsigned signs = 0;
  const char *p = at_;
  for (; p < end_ && (isLineBlank(*p) || (isSign(*p) && (several || signs == 0))); ++p)
    signs += isSign(*p);
  return signs > 1 || opensExpression(p);
}

/// A number with blanks or a plus before it, an expression, or nothing.
void IsoScanner::scanUnusualValue(AddressId address, const char *begin) {
  Word word;
  word.address = address;
  word.offset = offset(begin);
  const char *const afterName = at_;
  skipBlanks();
  if (lexical_.incrementOperator && at_ + 1 < end_ && (*at_ | 32) == 'i' &&
      (isNumberDigit(at_[1]) || at_[1] == '-' || at_[1] == '+' || at_[1] == '.')) {
    word.flags |= wordIncremental;
    ++at_;
  }
  if (commaFraction() || (numberFollows() && !signsExpression())) {
    if (!scanNumber(word, begin))
      word.flags |= wordMalformed | wordNoValue;
    return addNumber(word, begin);
  }
  if (lexical_.macro && at_ < end_ && (opensExpression(at_) || *at_ == '-' || *at_ == '+')) {
    const char *const value = at_;
    word.mantissa = operand();
    word.flags |= wordExpression;
    passBareArithmetic(value);
    // Where a number names a place of the program it cannot be computed.
    if (address == letterAddress('N') || (!lexical_.flowWords && address == letterAddress('O')))
      return issue(SyntaxIssueKind::BadExpression, begin, at_);
    return append(word);
  }
  at_ = afterName;
  word.flags |= wordNoValue;
  word.length = lengthFrom(begin);
  issue(SyntaxIssueKind::MissingValue, begin, at_);
  append(word);
}

/// `#1 - #2` where only brackets hold operators: one issue for all of it.
void IsoScanner::passBareArithmetic(const char *begin) {
  if (lexical_.arithmetic != Arithmetic::Ngc)
    return;
  bool any = false;
  for (const char *p = afterBlanks(at_);
       p < end_ && llvm::StringRef("+-*/").contains(*p) && opensOperand(afterBlanks(p + 1));
       p = afterBlanks(at_)) {
    at_ = afterBlanks(p + 1);
    while (at_ < end_ && *at_ == '*') // `**`
      ++at_;
    operand();
    any = true;
  }
  if (any)
    issue(SyntaxIssueKind::BadExpression, begin, at_);
}

/// Whether a value is here: a number, a variable, a bracket, a function.
bool IsoScanner::opensOperand(const char *p) const {
  return p < end_ && (isNumberDigit(*p) || *p == '.' || *p == '*' || opensExpression(p));
}

/// `,R2` and its like, also with blanks (`, R 2`); elsewhere a comma is no character of the
/// language.
void IsoScanner::scanComma() {
  const char *const begin = at_++;
  const char *const name = afterBlanks(at_);
  const char letter = name < end_ ? char(*name & ~32) : '\0';
  const AddressId address = letter == 'A'   ? commaA
                            : letter == 'C' ? commaC
                            : letter == 'R' ? commaR
                                            : noAddress;
  if (address == noAddress)
    return issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
  at_ = name + 1;
  scanWord(address, begin);
}

} // namespace ncvet
