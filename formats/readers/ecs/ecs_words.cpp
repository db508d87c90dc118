// Words of ECS blocks: block numbers, addresses with their values, assignments without brackets.
#include "formats/readers/ecs/ecs_scanner.h"

namespace ncvet {

void EcsScanner::keyword(CodeIndex code, const char *begin, const char *end) {
  Word word;
  word.address = keywordAddress;
  word.mantissa = code;
  const char *const at = at_;
  at_ = end;
  addWord(word, begin);
  at_ = at;
}

/// `N10` at the start of a block.
bool EcsScanner::scanNumberOfBlock(const char *begin) {
  const char *const next = begin + 1;
  if (next + 1 < end_ && (*next == '-' || *next == '+') && isNumberDigit(next[1]) &&
      startsBlock() && block_.number < 0) {
    for (at_ = next + 1; at_ < end_ && (isNumberDigit(*at_) || *at_ == '.');)
      ++at_;
    setNumber(begin, 0);
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
    return true;
  }
  if (const char *const value = afterBlanks(next);
      value < end_ && isNumberDigit(*value) && startsBlock() && block_.number < 0) {
    at_ = value;
    const int64_t number = takeWhole();
    const bool broken = at_ < end_ && (*at_ == '.' || *at_ == ',');
    while (broken && at_ < end_ && (isNumberDigit(*at_) || *at_ == '.' || *at_ == ','))
      ++at_;
    setNumber(begin, number);
    if (broken)
      issue(SyntaxIssueKind::MalformedNumber, begin, at_);
    return true;
  }
  return false;
}

/// Letters that mean nothing together.
bool EcsScanner::scanRun() {
  const char *const begin = at_;
  const llvm::StringRef run =
      llvm::StringRef(begin, size_t(end_ - begin)).take_while([](char c) { return isLetter(c); });
  // Bare axes (`G23 XYZ`) and K are without values; other runs of letters mean nothing.
  if (run.size() > 2 && run.find_first_not_of("XYZABCUVWKDxyzabcuvwkd") != llvm::StringRef::npos) {
    at_ = run.end();
    while (at_ < end_ && isNameCharacter(*at_))
      ++at_;
    issue(SyntaxIssueKind::UnknownWord, begin, at_);
    return true;
  }
  return false;
}

void EcsScanner::scanLetter() {
  const char *const begin = at_;
  const char letter = char(*at_ & ~32);
  block_.lowerCase |= *at_ >= 'a';
  const char *const next = at_ + 1;
  if (next < end_ && isLetter(*next)) {
    // `DX`, `RA`, `SM`: two letters that no further letter follows.
    const auto two = addresses_.find(llvm::StringRef(begin, 2).upper());
    if (two != addresses_.end() && (next + 1 == end_ || !isLetter(next[1]))) {
      at_ += 2;
      return scanValue(two->second, begin);
    }
    if (scanRun())
      return;
  }
  const AddressId address = letterAddress(letter);
  const bool digit = next < end_ && isNumberDigit(*next);
  switch (letter) {
  case 'N':
    if (scanNumberOfBlock(begin))
      return;
    break;
  case 'R':
  case 'V': {
    const char *p = next;
    while (p < end_ && isNumberDigit(*p))
      ++p;
    const char *const sign = afterBlanks(p);
    if (p > next && sign < end_ && *sign == '=')
      return scanAssignment(begin);
    break;
  }
  case 'L': {
    const char *const open = afterBlanks(next);
    if (open < end_ && *open == '<') {
      at_ = open;
      return scanCall(begin);
    }
    if (digit)
      return scanElement(begin);
    break;
  }
  case 'P':
  case 'O':
    if (digit)
      return scanElement(begin);
    break;
  case 'G':
    if (end_ - next > 2 && next[0] == '1' && next[1] == '6')
      if (const char *const axes = afterBlanks(next + 2); axes < end_ && isLetter(*axes))
        return scanPlane(begin);
    break;
  default:
    break;
  }
  ++at_;
  scanValue(address, begin);
}

/// `G16XYZ+`: a free plane, its axis and direction. A minus after it is a separate code.
void EcsScanner::scanPlane(const char *begin) {
  at_ = afterBlanks(begin + 3);
  const char *const axes = at_;
  while (at_ < end_ && isLetter(*at_))
    ++at_;
  const llvm::StringRef letters(axes, size_t(at_ - axes));
  const CodeIndex code = dialect_.keyword("G16" + letters.upper());
  const bool sign = at_ < end_ && (*at_ == '+' || *at_ == '-');
  at_ += sign;
  if (code == noCode || !sign) {
    while (!atLineEnd() && !isLineBlank(*at_) && *at_ != '<')
      ++at_;
    Word word; // a plane all the same, which one is not known
    word.address = letterAddress('G');
    word.mantissa = 16;
    word.flags = wordMalformed;
    addWord(word, begin);
    return;
  }
  const char *const mark = at_ - 1;
  const CodeIndex minus = *mark == '-' ? dialect_.keyword("G16-") : noCode;
  if (minus == noCode)
    return keyword(code, begin, at_);
  keyword(code, begin, mark);
  keyword(minus, mark, at_);
}

/// `G M T N` select something by its number.
static bool takesInteger(AddressId address) {
  return address == letterAddress('G') || address == letterAddress('M') ||
         address == letterAddress('T') || address == letterAddress('N');
}

/// `<R5>`: a value of real variables that no function makes whole. The marks `%` and `%%` of a
/// name say that it holds whole numbers.
bool EcsScanner::isReal(uint16_t index, llvm::StringRef text) const {
  const Expression &expression = block_.expressions[index];
  if (expression.bad || text.contains('%'))
    return false;
  bool variable = false;
  for (const ExpressionOp &op :
       llvm::makeArrayRef(block_.operations).slice(expression.first, expression.count)) {
    if (op.op == Op::Truncate)
      return false;
    variable |= op.op == Op::Variable;
  }
  return variable;
}

/// `= expression` or `<expression>` after an address.
void EcsScanner::scanExpression(AddressId address, const char *begin) {
  Word word;
  word.address = address;
  uint16_t index = 0;
  if (*at_ == '<') {
    const char *const open = at_;
    index = bracketed();
    if (takesInteger(address) && isReal(index, {open, size_t(at_ - open)}))
      issue(SyntaxIssueKind::RealForInteger, begin, at_);
  } else {
    ++at_;
    skipBlanks();
    if (atLineEnd() || *at_ == '<') {
      word.flags = wordNoValue;
      issue(SyntaxIssueKind::MissingValue, begin, at_);
      return addWord(word, begin);
    }
    index = expression();
    if (takesInteger(address))
      issue(SyntaxIssueKind::RealForInteger, begin, at_);
  }
  word.flags = wordExpression;
  word.mantissa = index;
  extendExpression(word);
  return addWord(word, begin);
}

/// The number, `= expression` or `<expression>` after an address.
void EcsScanner::scanValue(AddressId address, const char *begin) {
  Word word;
  word.address = address;
  if (at_ < end_ && (isNumberDigit(*at_) || *at_ == '-')) {
    if (const char *const after = readPlainNumber(at_, end_, word)) {
      at_ = after;
      // `G54.01`: two digits after the point are a separate number.
      if (address == letterAddress('G') && word.decimals == 2)
        if (const CodeIndex code = dialect_.keyword({begin, size_t(at_ - begin)}); code != noCode)
          return keyword(code, begin, at_);
      // `D0`: no segment, and no number of a correction.
      if (address == letterAddress('D') && word.mantissa == 0)
        if (const CodeIndex code = dialect_.keyword({begin, size_t(at_ - begin)}); code != noCode)
          return keyword(code, begin, at_);
      addWord(word, begin);
      if (address == letterAddress('G') && skipVariantName(begin))
        issue(SyntaxIssueKind::SymbolAsAddress, begin, at_);
      return;
    }
  }
  const char *const value = afterBlanks(at_);
  const char c = value < end_ ? *value : '\n';
  if (c == '=' || c == '<') {
    // After K, and where axes are only named, a bracket is a separate item.
    const bool bare = c == '<' && (value > at_ || address == letterAddress('K'));
    if (!bare) {
      at_ = value;
      return scanExpression(address, begin);
    }
  }
  if (isNumberDigit(c) || c == '-' || c == '+' || c == '.' || typographicMinus(value, end_)) {
    if (value > at_ && isNumberDigit(c))
      issue(SyntaxIssueKind::BlankInNumber, begin, value + 1);
    at_ = value;
    if (!scanNumber(word, begin))
      word.flags |= wordNoValue | wordMalformed;
    return addWord(word, begin);
  }
  word.flags = wordNoValue;
  if (address != letterAddress('K')) // a flag
    issue(SyntaxIssueKind::MissingValue, begin, at_);
  addWord(word, begin);
}

/// `G81/3`, `G83/R`: manuals name the variants of a cycle so, programs have the code alone.
bool EcsScanner::skipVariantName(const char *begin) {
  const char *const name = at_ + 1;
  if (at_ - begin < 2 || at_ == end_ || *at_ != '/' || name == end_ ||
      !(isNumberDigit(*name) || (*name | 32) == 'r') ||
      (name + 1 < end_ && isNameCharacter(name[1])))
    return false;
  at_ = name + 1;
  return true;
}

bool EcsScanner::scanNumber(Word &word, const char *begin) {
  const bool negative = takeSign(word, begin);
  if (!takeDigits(word, begin, negative, /*leadingComma=*/true))
    return false;
  takeExcess(word, begin);
  return true;
}

/// `L1`, `P2`, `O5`: an element of a contour by its name; `=` defines it.
void EcsScanner::scanElement(const char *begin) {
  const char letter = char(*begin & ~32);
  Word word;
  word.address = letterAddress(letter);
  ++at_;
  word.mantissa = takeWhole(1'000'000'000);
  addWord(word, begin);
  const char *const sign = afterBlanks(at_);
  if (sign == end_ || *sign != '=')
    return;
  // What defines it moves nothing: its words are its own.
  at_ = lineEnd();
  if (const CodeIndex code = dialect_.keyword("ELEMENT"); code != noCode)
    keyword(code, begin, at_);
}

/// `R1 = R2 + 10`, `#271=5`
void EcsScanner::scanAssignment(const char *begin) {
  Item item = itemAt(ItemKind::Assignment, begin);
  item.target = parsed(&EcsExpression::parseTarget);
  item.nameBegin = item.begin;
  item.nameEnd = offset(at_);
  skipBlanks();
  if (at_ == end_ || *at_ != '=') {
    at_ = std::max(at_, begin + 1);
    return issue(SyntaxIssueKind::MissingEquals, begin, at_);
  }
  ++at_;
  skipBlanks();
  if (atLineEnd())
    return issue(SyntaxIssueKind::MissingValue, begin, at_);
  item.value = expression();
  add(item);
}

} // namespace ncvet
