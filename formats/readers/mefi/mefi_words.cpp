// Words of MEFI blocks: addresses with their values, assignments.
#include "formats/readers/mefi/mefi_scanner.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

/// A letter and its number; `R30 = 2` is an assignment.
void MefiScanner::scanWord() {
  const char *const begin = at_;
  Word word;
  word.address = letterAddress(llvm::toUpper(*at_));
  if (word.address == letterAddress('R') && scanParameter())
    return;
  ++at_;
  skipLineBlanks();
  if (!scanNumber(word, begin)) {
    at_ = begin + 1;
    word.flags |= wordNoValue;
    issue(SyntaxIssueKind::MissingValue, begin, at_);
  }
  addWord(word, begin);
}

/// `R30 = 2`, and `R31-15`, `R28 4`, where the sign that gives the parameter its value is missing;
/// false, with nothing read, when it is a word.
bool MefiScanner::scanParameter() {
  const llvm::StringRef name(at_, 1 + rest().drop_front().take_while(isNumberDigit).size());
  if (name.size() == 1)
    return false;
  const char *const after = afterLineBlanks(name.end());
  if (after < end_ && *after == '=') {
    at_ = after + 1;
    scanAssignment(name);
    return true;
  }
  const char *digit = after;
  while (digit < end_ && (*digit == '-' || *digit == '+'))
    ++digit;
  if (digit == name.end() || digit == end_ || !isNumberDigit(*digit) || !isParameter(name))
    return false;
  at_ = after;
  scanAssignment(name);
  issue(SyntaxIssueKind::MissingEquals, name.begin(), at_);
  return true;
}

/// A variable of a letter and digits that some code reads.
bool MefiScanner::isParameter(llvm::StringRef name) const {
  const uint64_t wanted = variableKey(name);
  return llvm::any_of(dialect_.codes, [&](const CodeInfo &code) {
    return llvm::any_of(code.words, [&](const WordSpec &w) { return w.variable == wanted; });
  });
}

/// An address and a number that begins with the letter O: `GO`, `MO5`, `XO.5`; false, with nothing
/// read, when it is a name.
bool MefiScanner::scanLetterNumber() {
  const char *const begin = at_;
  const AddressId address = letterAddress(llvm::toUpper(*at_));
  if (address == letterAddress('N') || !(dialect_.known & maskOf(address)) || !readsAsZero(at_ + 1))
    return false;
  while (++at_ < end_ && (*at_ == 'O' || *at_ == 'o' || *at_ == '.' || isNumberDigit(*at_)))
    ;
  const char *const after = afterLineBlanks(at_);
  if (after < end_ && (*after == '=' || *after == '(')) {
    at_ = begin;
    return false;
  }
  issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  Word word;
  word.address = address;
  word.flags |= wordNoValue | wordMalformed;
  addWord(word, begin);
  return true;
}

/// `name = value`, the value a number or a name; the cursor is after the sign. It is a word too.
void MefiScanner::scanAssignment(llvm::StringRef name) {
  const char *const begin = name.begin();
  skipLineBlanks();
  Word word;
  word.address = variableAddress;
  word.offset = offset(begin);
  if (at_ + 1 < end_ && isLetter(*at_) && !startsBlock() && isNameLetter(at_[1])) {
    word.mantissa = keyOf(takeName());
    word.flags |= wordExpression;
  } else if (!scanNumber(word, begin)) {
    word.flags |= wordNoValue;
    issue(SyntaxIssueKind::MissingValue, begin, at_);
  }
  Item item = itemAt(ItemKind::Assignment, begin);
  nameItem(item, name);
  item.target = keyOf(name);
  item.value = word.has(wordExpression) ? uint16_t(word.mantissa) : valueOf(word);
  add(item);
  addWord(word, begin);
}

/// The key of the variable with this name, as an expression.
uint16_t MefiScanner::keyOf(llvm::StringRef name) {
  return constant(name.begin(), name.end(), double(variableKey(name)));
}

/// The number of `word`, which ends here.
uint16_t MefiScanner::valueOf(const Word &word) {
  const char *const begin = base_ + word.offset;
  return word.isNumber() ? constant(begin, at_, word.value()) : opaque(begin, at_);
}

} // namespace ncvet
