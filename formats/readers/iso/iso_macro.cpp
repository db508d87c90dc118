// Statements of Macro B: IF, GOTO, WHILE, DO, END, output, and assignments.
#include "formats/readers/iso/iso_scanner.h"

namespace ncvet {

bool IsoScanner::takeKeyword(llvm::StringRef word) {
  if (!isKeyword(word))
    return takeShort(word);
  at_ += word.size();
  return true;
}

/// The first two letters of a statement's word stand for it, where what comes next is no letter:
/// `WH [#1LT5] DO1`, `GO10`, `EN1` (0i and later; of other controls WH alone, which is no word).
bool IsoScanner::takeShort(llvm::StringRef word) {
  constexpr size_t letters = 2;
  const bool all = lexical_.arithmetic == Arithmetic::MacroB30;
  if ((!all && (word != "WHILE" || lexical_.arithmetic == Arithmetic::Ngc)) ||
      word.size() <= letters || !isKeyword(word.take_front(letters)))
    return false;
  const char *const next = word == "WHILE" ? afterBlanks(at_ + letters) : at_ + letters;
  if (next >= end_ || (*next != '[' && *next != '#' && !isNumberDigit(*next)))
    return false;
  at_ = next;
  return true;
}

/// The number of a loop, perhaps with blanks before it; 0 when there is none.
uint8_t IsoScanner::loopNumber() {
  skipBlanks();
  return uint8_t(takeWhole(UINT8_MAX));
}

/// A statement that begins with a letter; false, with nothing read, when there is none here.
bool IsoScanner::scanStatement() {
  switch (*at_ & ~32) {
  case 'I':
    return scanIf();
  case 'T':
    return scanThen();
  case 'G':
    return scanGoto();
  case 'W':
    return scanWhile();
  case 'D':
    return scanOutputLine("DPRNT") || scanLoopMark("DO", ItemKind::Do);
  case 'E':
    return scanLoopMark("END", ItemKind::End);
  case 'P':
    return scanOutputWord("POPEN") || scanOutputWord("PCLOS");
  case 'B':
    return scanOutputLine("BPRNT");
  case 'S':
    return scanOutputLine("SETVN");
  default:
    return false;
  }
}

bool IsoScanner::scanIf() {
  const char *const begin = at_;
  if (!takeKeyword("IF"))
    return false;
  skipBlanks();
  if (at_ >= end_ || (*at_ != '[' && (*at_ != '#' || lexical_.flowWords))) {
    at_ = begin;
    return false;
  }
  Item item = itemAt(ItemKind::If, begin);
  const char *const condition = at_;
  const bool open = *at_ != '['; // `IF #1 EQ 2`
  item.condition = operand();
  if (passComparison() || open)
    spoil(item.condition, condition);
  add(item);
  return true;
}

/// A condition without brackets around all of it.
void IsoScanner::spoil(uint16_t condition, const char *begin) {
  Expression &whole = block_.expressions[condition];
  whole.bad = true;
  whole.end = offset(at_);
  whole.first = uint32_t(block_.operations.size());
  whole.count = 1;
  block_.operations.push_back({Op::Unknown, whole.begin, 0});
  issue(SyntaxIssueKind::BadExpression, begin, at_);
}

/// `[#1]GE[2]`, a condition without brackets around all of it: passes over what is after its first
/// operand. False, with nothing read: there is none.
bool IsoScanner::passComparison() {
  bool any = false;
  for (;;) {
    const char *const next = afterBlanks(at_);
    const size_t length = MacroExpression::namesOperator({next, size_t(end_ - next)});
    if (!length)
      return any;
    const char *const value = afterBlanks(next + length);
    if (value >= end_ || (*value != '[' && *value != '#' && *value != '.' && *value != '-' &&
                          !isNumberDigit(*value)))
      return any;
    at_ = value;
    operand();
    any = true;
  }
}

/// `THEN`, and a statement after it in the same block.
bool IsoScanner::scanThen() {
  const char *const begin = at_;
  if (!takeKeyword("THEN"))
    return false;
  if (const char *const next = afterBlanks(at_); next >= end_ || isLineEnd(*next) || *next == '(')
    issue(SyntaxIssueKind::BadStatement, begin, at_);
  return true;
}

/// `GO1 X5.`: a G with the letter O for a zero, and not the short form of GOTO, which ends its
/// block.
bool IsoScanner::isMistypedRapid() const {
  const char *p = at_ + 2;
  if (p >= end_ || !isNumberDigit(*p))
    return false;
  while (p < end_ && isNumberDigit(*p))
    ++p;
  p = afterBlanks(p);
  return p < end_ && !isLineEnd(*p) && *p != '(' && *p != ';';
}

bool IsoScanner::scanGoto() {
  Item item = itemAt(ItemKind::Jump, at_);
  if (isKeyword("GO TO"))
    at_ += llvm::StringRef("GO TO").size();
  else if (isMistypedRapid() || !takeKeyword("GOTO"))
    return false;
  skipBlanks();
  item.value = operand();
  add(item);
  return true;
}

/// `WHILE [..] DO 1`
bool IsoScanner::scanWhile() {
  Item item = itemAt(ItemKind::While, at_);
  if (!takeKeyword("WHILE"))
    return false;
  skipBlanks();
  const char *const condition = at_;
  const bool open = at_ < end_ && *at_ == '#' && !lexical_.flowWords; // `WHILE #1 LT 2 DO1`
  item.condition = operand();
  if (open && item.condition != noExpression) {
    passComparison();
    spoil(item.condition, condition);
  }
  skipBlanks();
  if (takeKeyword("DO"))
    item.loop = loopNumber();
  else
    issue(SyntaxIssueKind::BadStatement, base_ + item.begin, at_);
  add(item);
  return true;
}

/// `DO 1`, `END 1`
bool IsoScanner::scanLoopMark(llvm::StringRef keyword, ItemKind kind) {
  Item item = itemAt(kind, at_);
  const char *const after = at_ + keyword.size();
  if ((isKeyword(keyword) && after < end_ && isLetter(*after)) || !takeKeyword(keyword))
    return false; // `ENDIF` is none of this language
  item.loop = loopNumber();
  add(item);
  return true;
}

/// `POPEN`, `PCLOS`
bool IsoScanner::scanOutputWord(llvm::StringRef keyword) {
  Item item = itemAt(ItemKind::Output, at_);
  if (!takeKeyword(keyword))
    return false;
  add(item);
  return true;
}

/// `DPRNT[..]`: the rest of the line is its text, which a bracket closes.
bool IsoScanner::scanOutputLine(llvm::StringRef keyword) {
  Item item = itemAt(ItemKind::Output, at_);
  if (!isKeyword(keyword))
    return false;
  const char *const begin = at_;
  at_ = lineEnd();
  const llvm::StringRef text(begin, size_t(at_ - begin));
  if (text.count(']') < std::max<size_t>(text.count('['), 1))
    issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
  add(item);
  return true;
}

/// `#1 = …`, `#[#2 + 1] = …`
void IsoScanner::scanAssignment() {
  const char *const begin = at_;
  Item item = itemAt(ItemKind::Assignment, begin);
  item.target = expression(MacroExpression::Form::VariableNumber);
  // What it is called, without its marks.
  const bool marked = begin + 1 < at_ && begin[1] == '<';
  item.nameBegin = offset(begin) + (marked ? 2 : 1);
  item.nameEnd = std::max(item.nameBegin, offset(at_) - (marked ? 1 : 0));
  skipBlanks();
  if (at_ < end_ && *at_ == '=') {
    ++at_;
    const char *const value = afterBlanks(at_);
    item.value = expression(MacroExpression::Form::Full);
    passBareArithmetic(value);
    return add(item);
  }
  issue(SyntaxIssueKind::BadStatement, begin, at_ > begin ? at_ : begin + 1);
  if (at_ == begin)
    ++at_;
}

/// `[#NAME]=..`
void IsoScanner::scanNamedVariable() {
  const char *const begin = at_;
  Item item = itemAt(ItemKind::Assignment, begin);
  item.target = expression(MacroExpression::Form::VariableNumber);
  skipBlanks();
  if (at_ >= end_ || *at_ != '=')
    return issue(SyntaxIssueKind::BadStatement, begin, at_ > begin ? at_ : begin + 1);
  ++at_;
  item.value = expression(MacroExpression::Form::Full);
  add(item);
}

} // namespace ncvet
