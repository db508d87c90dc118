// Words of Sinumerik blocks: addresses with their values, names, assignments.
#include "formats/readers/sinumerik/sinumerik_scanner.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet {

void SinumerikScanner::addExpression(AddressId address, const char *begin, uint16_t expression,
                                     WordReading reading) {
  Word word;
  word.address = address;
  word.flags = wordExpression;
  word.decimals = uint8_t(reading);
  word.mantissa = expression;
  addWord(word, begin);
}

/// A number, a label or a program's name at the start of a block.
bool SinumerikScanner::scanStart(char letter) {
  const char *const begin = at_;
  // `N10` before it, `L10` a program's name, `R1=` a variable; all of them may be a label.
  if (letter == 'N' && block_.number < 0) {
    ++at_;
    scanNumberOfBlock(begin);
    return true;
  }
  if (scanLabel())
    return true;
  if (letter == 'L') {
    Item item = itemAt(ItemKind::Call, begin);
    const llvm::StringRef name = identifier();
    if (llvm::all_of(name.drop_front(), isNumberDigit) && !isEquals(afterBlanks(name.end()))) {
      at_ = name.end();
      scanCall(name, item);
      return true;
    }
  }
  return false;
}

/// A number that blanks may separate from its letter.
void SinumerikScanner::scanDistant(char letter, const char *begin) {
  const char *const value = at_;
  Word word;
  word.address = letterAddress(letter);
  const char *const digits = at_;
  while (at_ < end_ && isNumberDigit(*at_))
    ++at_;
  if (at_ > digits && isEquals(at_)) {
    at_ = begin;
    return scanExtended(letter, begin);
  }
  at_ = value;
  if (!scanNumber(word, begin))
    word.flags |= wordNoValue | wordMalformed;
  addWord(word, begin);
}

/// `R1=5 R2=0`: values of R parameters are all that the block has so far. Cycles of older controls
/// are called right after them.
bool SinumerikScanner::givesParameters() const {
  return block_.words.empty() && !block_.items.empty() &&
         llvm::all_of(block_.items, [&](const Item &item) {
           return item.kind == ItemKind::Assignment && (base_[item.nameBegin] | 32) == 'r' &&
                  isNumberDigit(base_[item.nameBegin + 1]);
         });
}

/// A letter and its number, or what else begins with a letter.
void SinumerikScanner::scanLetter() {
  const char *const begin = at_;
  const char letter = char(*at_ & ~32);
  const char *const next = at_ + 1;
  if (next < end_ && isNameLetter(*next))
    return scanName();
  if (next < end_ && isNumberDigit(*next) && startsBlock() && scanStart(letter))
    return;
  if (letter == 'R' && next < end_ && (isNumberDigit(*next) || *next == '['))
    return scanAssignment(begin);
  if (letter == 'L' && next < end_ && isNumberDigit(*next) && givesParameters() &&
      scanStart(letter))
    return;
  if (next < end_ && *next == ':' && scanLabel()) // too short, but nothing else
    return;
  ++at_;
  const AddressId address = letterAddress(letter);
  if (at_ < end_ && (isNumberDigit(*at_) || *at_ == '-')) {
    Word word;
    word.address = address;
    if (const char *const after = readPlainNumber(at_, end_, word)) {
      // `X1 = 10`; a G code takes no value.
      if (letter != 'G' && word.isWhole() && !word.has(wordMinus) && isEquals(afterBlanks(after))) {
        at_ = begin;
        return scanExtended(letter, begin);
      }
      // `M1R=5`: no word is `R` alone, so that all of it is a name.
      if (after < end_ && (*after | 32) == 'r' && isEquals(afterBlanks(after + 1))) {
        at_ = begin;
        return scanAssignment(begin);
      }
      // An exponent is part of the number.
      if (!(after + 1 < end_ && (after[0] | 32) == 'e' && (after[1] | 32) == 'x')) {
        at_ = after;
        return addWord(word, begin);
      }
    }
  }
  scanAfterLetter(letter, begin);
}

/// What comes after a letter, where no plain number does.
void SinumerikScanner::scanAfterLetter(char letter, const char *begin) {
  const AddressId address = letterAddress(letter);
  const char *const value = afterBlanks(at_);
  if (isEquals(value)) {
    at_ = value + 1;
    return scanValue(address, begin);
  }
  if (value + 1 < end_ && value[0] == '=' && value[1] == '=') { // the value counts
    issue(SyntaxIssueKind::AssignmentInTest, value, value + 2);
    at_ = value + 2;
    return scanValue(address, begin);
  }
  if (value < end_ && *value == '[')
    return scanIndexed(begin, address);
  if (value < end_ && *value == '(' && value == at_) {
    issue(SyntaxIssueKind::MissingEquals, begin, at_);
    return scanValue(address, begin);
  }
  if (value < end_ && (isNumberDigit(*value) || *value == '-' || *value == '+' || *value == '.' ||
                       typographicMinus(value, end_))) {
    at_ = value;
    return scanDistant(letter, begin);
  }
  Word word;
  word.address = address;
  word.flags = wordNoValue;
  issue(SyntaxIssueKind::MissingValue, begin, at_);
  addWord(word, begin);
}

/// `X1=10`, `S2=500`, `M2=3`, `I1=5`: the number belongs to the address.
void SinumerikScanner::scanExtended(char letter, const char *begin) {
  ++at_;
  const llvm::StringRef digits = llvm::StringRef(at_, size_t(end_ - at_)).take_while(isNumberDigit);
  at_ = afterBlanks(digits.end()) + 1; // after the `=`
  const auto named = addresses_.find(llvm::StringRef(begin, digits.size() + 1).upper());
  if (named != addresses_.end())
    return scanValue(named->second, begin);
  // The first spindle is the one that words without a number speak of.
  if ((letter == 'S' || letter == 'M' || letter == 'T') && digits == "1")
    return scanValue(letterAddress(letter), begin);
  if (letter == 'S' || letter == 'M' || letter == 'T' || letter == 'H') {
    // Another spindle, or a function of the machine builder's: nothing of the tool that cuts.
    Item item = itemAt(ItemKind::Output, begin);
    if (letter == 'S' || letter == 'M') // of which spindle it is
      item.target = constant(begin, digits.end(), double(variableKey({begin, digits.size() + 1})));
    item.value = expression();
    if (letter == 'M') // a function of it, not its speed
      item.count = item.value;
    return add(item);
  }
  if (letter == 'D' || letter == 'L') {
    Item item = itemAt(ItemKind::Assignment, begin);
    item.nameBegin = item.begin;
    item.nameEnd = offset(digits.end());
    item.target = constant(begin, digits.end(), double(variableKey({begin, digits.size() + 1})));
    item.value = expression();
    return add(item);
  }
  const char *const from = at_;
  if (addActing({begin, digits.size() + 1})) {
    Item item = itemAt(ItemKind::Assignment, begin);
    item.nameBegin = item.begin;
    item.nameEnd = offset(digits.end());
    item.target = constant(begin, digits.end(), double(variableKey({begin, digits.size() + 1})));
    item.value = expression();
    add(item);
    addValue(item);
    at_ = from;
  }
  // An axis of the machine: where it goes says nothing of the workpiece's axes.
  if (!(dialect_.known & maskOf(letterAddress(letter)))) { // `Q1=5`: one that the builder has named
    Item item = itemAt(ItemKind::Output, begin);
    item.value = expression();
    return add(item);
  }
  const uint16_t value = expression();
  if (value < block_.expressions.size() && !block_.expressions[value].bad) {
    block_.operations.push_back({Op::Opaque, offset(begin), 1});
    ++block_.expressions[value].count;
  }
  addExpression(letterAddress(letter), begin, value);
}

/// `0,5`: a number with a comma for its point.
bool SinumerikScanner::atDecimalComma() const {
  const char *p = at_;
  p += p < end_ && *p == '-';
  const char *const digits = p;
  while (p < end_ && isNumberDigit(*p))
    ++p;
  return p > digits && p + 1 < end_ && *p == ',' && isNumberDigit(p[1]);
}

/// What comes after `=`: most often a plain number.
void SinumerikScanner::scanValue(AddressId address, const char *begin) {
  skipBlanks();
  Word word;
  word.address = address;
  if (atDecimalComma()) {
    scanNumber(word, begin);
    return addWord(word, begin);
  }
  if (at_ < end_ && (isNumberDigit(*at_) || *at_ == '-')) {
    if (const char *const after = readPlainNumber(at_, end_, word)) {
      const char *const next = afterBlanks(after);
      const bool ends = next == end_ || isLineEnd(*next) || *next == ';' ||
                        (isNameLetter(*next) && next > after) ||
                        (isLetter(*next) && next + 1 < end_ && !isNameLetter(next[1]));
      const llvm::StringRef word2 =
          llvm::StringRef(next, size_t(end_ - next)).take_while(isNameCharacter);
      if (ends && !word2.equals_insensitive("DIV") && !word2.equals_insensitive("MOD") &&
          !word2.startswith_insensitive("B_")) {
        at_ = after;
        return addWord(word, begin);
      }
    }
  }
  if (atBlockEnd()) {
    word.flags = wordNoValue;
    issue(SyntaxIssueKind::MissingValue, begin, at_);
    return addWord(word, begin);
  }
  WordReading reading;
  const uint16_t index = parsed(&SinumerikExpression::parseValue, reading);
  addExpression(address, begin, index, reading);
}

/// `PO[X]=(20,1.5,-0.2)`, `PO[]=(1,0.5)/(2,0.1)`: the axis goes along a polynomial, where to is not
/// followed. The cursor is at the bracket.
void SinumerikScanner::scanPolynomial(const char *begin) {
  const llvm::StringRef axis =
      llvm::StringRef(at_, size_t(end_ - at_)).drop_front().take_while(isNameCharacter);
  skipIndices();
  skipBlanks();
  if (!isEquals(at_)) {
    issue(SyntaxIssueKind::MissingEquals, begin, at_);
    return;
  }
  ++at_;
  Item item = itemAt(ItemKind::Output, begin);
  skipBlanks();
  while (at_ < end_ && *at_ == '(') {
    scanArguments(item, /*words=*/false);
    if (const char *const after = afterBlanks(at_); after < end_ && *after == '/')
      at_ = afterBlanks(after + 1);
  }
  if (!item.arguments) {
    issue(SyntaxIssueKind::BadExpression, begin, at_);
    return rest();
  }
  if (axis.size() == 1 && isLetter(axis[0]))
    return addExpression(letterAddress(char(axis[0] & ~32)), begin, opaque(begin, at_));
  add(item);
}

/// `M[R1]=3`, `AX[_OSA]=5`, `FL[X]=100`, `POS[Y]=20`.
void SinumerikScanner::scanIndexed(const char *begin, AddressId address) {
  const char *p = afterBlanks(at_);
  int depth = 0;
  for (; p < end_ && !isLineEnd(*p) && *p != ';'; ++p) {
    depth += *p == '[';
    depth -= *p == ']';
    if (depth == 0)
      break;
  }
  if (p == end_ || *p != ']') {
    issue(SyntaxIssueKind::UnbalancedBracket, begin, p);
    at_ = p;
    return;
  }
  at_ = afterBlanks(p + 1);
  if (!isEquals(at_)) {
    if (address == noAddress && switchesAxis(begin)) {
      Item item = itemAt(ItemKind::Output, begin);
      return add(item);
    }
    issue(SyntaxIssueKind::MissingEquals, begin, p + 1);
    return;
  }
  if (address == noAddress) {
    at_ = begin;
    return scanAssignment(begin);
  }
  ++at_;
  const uint16_t value = expression();
  addExpression(address, begin, opaque(begin, base_ + block_.expressions[value].end));
}

/// `SCC[X]`, `DIAM90A[X]`: an axis gets a property, and no value.
bool SinumerikScanner::switchesAxis(const char *begin) const {
  const llvm::StringRef name =
      llvm::StringRef(begin, size_t(end_ - begin)).take_while(isNameCharacter);
  return llvm::any_of(dialect_.lexical.axisSwitches,
                      [&](llvm::StringRef one) { return name.equals_insensitive(one); });
}

/// A number that is not as usual; false, with an issue, when there is no digit in it.
bool SinumerikScanner::scanNumber(Word &word, const char *begin) {
  const bool negative = takeSign(word, begin);
  const char *const first = at_;
  if (!takeDigits(word, begin, negative, /*leadingComma=*/false))
    return false;
  if (*first == '0' && first + 1 < end_ && isNumberDigit(first[1]))
    word.flags |= wordLeadingZero;
  const bool excess = takeExcess(word, begin);
  if (!excess && at_ + 1 < end_ && (at_[0] | 32) == 'e' && (at_[1] | 32) == 'x') {
    // With an exponent the value is an expression of one number.
    at_ = first;
    const uint16_t index = expression();
    if (negative) {
      block_.operations.push_back({Op::Negate, offset(first), 0});
      ++block_.expressions[index].count;
    }
    word.flags = wordExpression;
    word.decimals = 0;
    word.mantissa = index;
  }
  return true;
}

/// What comes after an address of several letters, which begins at `begin`.
void SinumerikScanner::scanAddress(AddressId address, const char *begin) {
  const char *const after = afterBlanks(at_);
  if (isEquals(after)) {
    at_ = after + 1;
    return scanValue(address, begin);
  }
  if (after < end_ && *after == '[')
    return scanIndexed(begin, address);
  issue(SyntaxIssueKind::MissingEquals, begin, at_);
  at_ = after;
  if (!atBlockEnd() && (isNumberDigit(*at_) || *at_ == '-' || *at_ == '(' || *at_ == '.'))
    scanValue(address, begin);
}

/// `YO`: the letter O for a zero.
bool SinumerikScanner::isLetterForZero(llvm::StringRef name, const char *after) const {
  return name.size() == 2 && (name[1] | 32) == 'o' &&
         llvm::StringRef("XYZ").contains(char(name[0] & ~32)) &&
         (after == end_ || (*after != '(' && *after != ':'));
}

void SinumerikScanner::letterForZero(llvm::StringRef name) {
  at_ = name.end();
  issue(SyntaxIssueKind::MalformedNumber, name.begin(), at_);
  Word word;
  word.address = letterAddress(char(name[0] & ~32));
  addWord(word, name.begin());
}

/// Two letters and more: a keyword, an address with `=`, a variable, a code, a call.
void SinumerikScanner::scanName() {
  const char *const begin = at_;
  if (scanLabel())
    return;
  const llvm::StringRef name = identifier();
  const Keyword keyword = sinumerikKeyword(name);
  if (keyword != Keyword::None &&
      (keyword != Keyword::Identity || isEquals(afterBlanks(name.end())))) {
    at_ = name.end();
    return scanStatement(keyword, begin);
  }
  if (scanPartedEnd(name))
    return;
  const char *const after = afterBlanks(name.end());
  const auto address = addresses_.find(name.upper());
  if (address != addresses_.end()) {
    at_ = name.end();
    return scanAddress(address->second, begin);
  }
  if (isEquals(after))
    return scanAssignment(begin, addActing(name));
  if (after < end_ && *after == '[') {
    at_ = name.end();
    if (name.equals_insensitive("PO")) {
      at_ = after;
      return scanPolynomial(begin);
    }
    return scanIndexed(begin, noAddress);
  }
  if (const CodeIndex code = codeNamed(name); code != noCode)
    return scanCode(code, name);
  if (isLetterForZero(name, after))
    return letterForZero(name);
  // `CR20`: an address of several letters and its number, without the `=`.
  const llvm::StringRef letters = name.take_while([](char c) { return !isNumberDigit(c); });
  const auto glued = addresses_.find(letters.upper());
  if (letters.size() < name.size() && glued != addresses_.end() &&
      llvm::all_of(name.drop_front(letters.size()), isNumberDigit)) {
    at_ = letters.end();
    Word word;
    word.address = glued->second;
    scanNumber(word, begin);
    issue(SyntaxIssueKind::MissingEquals, begin, at_);
    return addWord(word, begin);
  }
  // `XR1`: a variable after its address, without the `=`.
  if (name.size() > 2 && (name[1] | 32) == 'r' && isLetter(name[0]) &&
      llvm::all_of(name.drop_front(2), isNumberDigit)) {
    issue(SyntaxIssueKind::MissingEquals, begin, name.end());
    at_ = begin + 1;
    return scanValue(letterAddress(char(*begin & ~32)), begin);
  }
  scanProgram(name);
}

/// A program that is called; in `SETINT(3) PRIO=1 LIFT` one that an input starts, not the block.
void SinumerikScanner::scanProgram(llvm::StringRef name) {
  const CodeIndex interrupt = dialect_.keyword("SETINT");
  const bool later = interrupt != noCode && llvm::any_of(block_.words, [&](const Word &word) {
                       return word.address == keywordAddress && word.mantissa == interrupt;
                     });
  Item item = itemAt(later ? ItemKind::Output : ItemKind::Call, name.begin());
  at_ = name.end();
  if (later)
    return add(item);
  scanCall(name, item);
}

/// `PW=2`, `LEAD=5`: a name of the language that takes a value. It is a code of its block where the
/// table says more of it than its title.
bool SinumerikScanner::addActing(llvm::StringRef name) {
  const CodeIndex code = dialect_.keyword(name);
  const bool acts = code != noCode &&
                    (!dialect_.codes[code].notices.empty() || !dialect_.codes[code].words.empty());
  if (acts)
    addKeyword(name);
  return acts;
}

/// The value of such a name as a word of its code.
void SinumerikScanner::addValue(const Item &item) {
  if (item.value == noExpression)
    return;
  Word word;
  word.address = variableAddress;
  word.flags = wordExpression;
  word.mantissa = item.value;
  addWord(word, base_ + item.begin);
}

/// `R1=..`, `NAME=..`, `FIELD[1]=..`, `$TC_DP6[1,1]=..`
void SinumerikScanner::scanAssignment(const char *begin, bool acting) {
  Item item = itemAt(ItemKind::Assignment, begin);
  item.nameBegin = item.begin;
  item.target = parsed(&SinumerikExpression::parseTarget);
  item.nameEnd = offset(at_);
  skipBlanks();
  if (!isEquals(at_)) {
    if (at_ == begin)
      ++at_;
    issue(SyntaxIssueKind::MissingEquals, begin, base_ + item.nameEnd);
    if (!atBlockEnd() && isNumberDigit(*at_)) // the value all the same
      expression();
    return;
  }
  ++at_;
  skipBlanks();
  if (atBlockEnd()) {
    issue(SyntaxIssueKind::MissingValue, begin, at_);
    return;
  }
  if (atDecimalComma()) {
    Word word;
    const char *const number = at_;
    scanNumber(word, begin);
    item.value = constant(number, at_, word.value());
  } else {
    const bool indexed = base_[item.nameEnd - 1] == ']';
    if (const uint16_t list = indexed ? scanList() : noExpression; list != noExpression)
      item.value = list;
    else
      item.value = expression();
  }
  add(item);
  if (acting)
    addValue(item);
}

} // namespace ncvet
