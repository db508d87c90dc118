// Reader of Sinumerik programs: word addresses, words with `=`, statements, calls by name.
#include "formats/readers/sinumerik_reader.h"

#include "formats/readers/block_scanner.h"
#include "formats/readers/plain_number.h"
#include "formats/readers/sinumerik_expression.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"

#include <algorithm>
#include <optional>

namespace ncvet {

namespace {

/// Other characters that do not print count as blanks; `&` does too.
bool isBlank(char c) { return isLineBlank(c) || c == '&'; }
bool isNameLetter(char c) { return isLetter(c) || c == '_'; }
bool isNameCharacter(char c) { return isNameLetter(c) || isNumberDigit(c); }

/// Words of the language that are no code: they open a statement.
enum class Keyword : uint8_t {
  None,
  If,
  Else,
  EndIf,
  Loop,
  EndLoop,
  For,
  EndFor,
  While,
  EndWhile,
  Repeat,
  RepeatBlock,
  Until,
  Goto,
  GotoForward,
  GotoBackward,
  GotoIfFound,
  GotoStart,
  Case,
  Def,
  Proc,
  Extern,
  Define,
  ModalCall,
  Call,
  PathCall,
  ExternalCall
};

Keyword keywordOf(llvm::StringRef name) {
  if (name.size() > 8)
    return Keyword::None;
  return llvm::StringSwitch<Keyword>(name.upper())
      .Case("IF", Keyword::If)
      .Case("ELSE", Keyword::Else)
      .Case("ENDIF", Keyword::EndIf)
      .Case("LOOP", Keyword::Loop)
      .Case("ENDLOOP", Keyword::EndLoop)
      .Case("FOR", Keyword::For)
      .Case("ENDFOR", Keyword::EndFor)
      .Case("WHILE", Keyword::While)
      .Case("ENDWHILE", Keyword::EndWhile)
      .Case("REPEAT", Keyword::Repeat)
      .Case("REPEATB", Keyword::RepeatBlock)
      .Case("UNTIL", Keyword::Until)
      .Case("GOTO", Keyword::Goto)
      .Case("GOTOF", Keyword::GotoForward)
      .Case("GOTOB", Keyword::GotoBackward)
      .Case("GOTOC", Keyword::GotoIfFound)
      .Case("GOTOS", Keyword::GotoStart)
      .Case("CASE", Keyword::Case)
      .Case("DEF", Keyword::Def)
      .Case("PROC", Keyword::Proc)
      .Case("EXTERN", Keyword::Extern)
      .Case("DEFINE", Keyword::Define)
      .Case("MCALL", Keyword::ModalCall)
      .Case("CALL", Keyword::Call)
      .Case("PCALL", Keyword::PathCall)
      .Case("EXTCALL", Keyword::ExternalCall)
      .Case("ISOCALL", Keyword::ExternalCall)
      .Default(Keyword::None);
}

bool isJump(Keyword keyword) { return keyword >= Keyword::Goto && keyword <= Keyword::GotoStart; }

VariableType typeOf(llvm::StringRef name) {
  return llvm::StringSwitch<VariableType>(name.upper())
      .Case("INT", VariableType::Integer)
      .Case("REAL", VariableType::Real)
      .Case("BOOL", VariableType::Boolean)
      .Case("CHAR", VariableType::Character)
      .Case("STRING", VariableType::String)
      .Case("AXIS", VariableType::Axis)
      .Case("FRAME", VariableType::Frame)
      .Default(VariableType::None);
}

class Scanner : BlockScanner<isBlank> {
public:
  Scanner(const Dialect &dialect, const llvm::StringMap<AddressId> &addresses, llvm::StringRef text,
          uint32_t offset, Block &block)
      : BlockScanner(text, offset, block), dialect_(dialect), addresses_(addresses) {}

  void scan();

private:
  /// Nothing but a comment is left of the block.
  bool atBlockEnd() const { return atLineEnd() || *at_ == ';'; }
  bool startsBlock() const { return block_.words.empty() && block_.items.empty(); }
  /// A single `=`, not the `==` of a comparison.
  bool isEquals(const char *p) const {
    return p < end_ && *p == '=' && (p + 1 == end_ || p[1] != '=');
  }
  llvm::StringRef identifier() const {
    const char *p = at_;
    while (p < end_ && isNameCharacter(*p))
      ++p;
    return {at_, size_t(p - at_)};
  }
  void rest() {
    while (!atBlockEnd())
      ++at_;
  }
  /// Steps over the brackets at hand, whatever they hold.
  void skipIndices() {
    if (at_ < end_ && *at_ == '[')
      while (!atBlockEnd() && *at_++ != ']')
        ;
  }

  void scanItem();
  void scanComment();
  void scanHeader();
  void scanSkip();
  void scanOther();
  std::optional<llvm::StringRef> scanString();
  bool scanLabel();
  void scanNumberOfBlock(const char *begin);
  void scanLetter();
  void scanExtended(char letter, const char *begin);
  void scanValue(AddressId address, const char *begin);
  bool scanNumber(Word &word, const char *begin);
  void scanIndexed(const char *begin, AddressId address);
  void addExpression(AddressId address, const char *begin, uint16_t expression,
                     WordReading reading = WordReading::Modal);

  void scanName();
  void scanStatement(Keyword keyword, const char *begin);
  void scanIf(const char *begin);
  void scanJump(Keyword keyword, const char *begin);
  void scanTarget(Item &item);
  void scanCase(const char *begin);
  void scanFor(const char *begin);
  void scanRepeat(bool single, const char *begin);
  void scanDefinitions();
  void scanParameters(ItemKind kind, const char *begin);
  void scanMacro(const char *begin);
  void scanModalCall(const char *begin, llvm::StringRef name);
  void scanIndirectCall(Keyword keyword, const char *begin);
  void scanCode(CodeIndex code, llvm::StringRef name);
  void scanCall(llvm::StringRef name, Item &item);
  void scanArguments(Item &item, bool words);
  void scanArgument(Item &item, char separator, bool words);
  void scanAssignment(const char *begin);
  void structure(Structure structure, const char *begin, uint16_t condition = noExpression);
  uint16_t expression() { return parsed(&SinumerikExpression::parse); }
  uint16_t condition() { return parsed(&SinumerikExpression::parseCondition); }

  const Dialect &dialect_;
  const llvm::StringMap<AddressId> &addresses_;
};

void Scanner::scan() {
  block_.begin = offset(at_);
  const char *content = at_;
  skipBlanks();
  if (at_ < end_ && *at_ == '%') {
    scanHeader();
    content = at_;
  } else {
    scanSkip();
    while (at_ < end_ && !isLineEnd(*at_)) {
      if (isBlank(*at_)) {
        ++at_;
        continue;
      }
      scanItem();
      content = at_;
    }
  }
  block_.end = offset(std::max(content, base_ + block_.begin));
  takeLineEnd();
  if (block_.kind == BlockKind::Normal && block_.isEmpty() && block_.issues.empty() &&
      block_.number < 0 && block_.skip < 0 && !block_.hasLabel())
    block_.kind = BlockKind::Empty;
}

/// `/`, `/3`: in front of everything else.
void Scanner::scanSkip() {
  if (at_ == end_ || *at_ != '/')
    return;
  ++at_;
  block_.skip = 0;
  if (at_ < end_ && isNumberDigit(*at_)) {
    int level = 0;
    while (at_ < end_ && isNumberDigit(*at_))
      level = std::min(127, level * 10 + (*at_++ - '0'));
    block_.skip = int8_t(level);
  }
}

void Scanner::scanItem() {
  const char c = *at_;
  if (isLetter(c))
    return scanLetter();
  if (c == ';')
    return scanComment();
  if (c == '_')
    return scanName();
  scanOther();
}

void Scanner::scanComment() {
  const char *const begin = at_;
  at_ = lineEnd();
  block_.comments.push_back({offset(begin), offset(at_)});
}

/// `%_N_SHAFT_MPF`, `%SHAFT_SPF`: the file as the control stores it. Any other `%` is none.
void Scanner::scanHeader() {
  const char *const begin = at_++;
  llvm::StringRef name = identifier();
  at_ = name.end();
  if (name.startswith_insensitive("_N_"))
    name = name.drop_front(3);
  if (name.endswith_insensitive("_MPF") || name.endswith_insensitive("_SPF")) {
    block_.kind = BlockKind::ProgramHeader;
    block_.headerBegin = offset(begin);
    block_.headerEnd = offset(at_);
    name = name.drop_back(4);
    block_.nameBegin = offset(name.begin());
    block_.nameEnd = offset(name.end());
  } else {
    block_.kind = BlockKind::Tape;
  }
  rest();
  if (!atLineEnd())
    scanComment();
}

void Scanner::scanOther() {
  const char *const begin = at_;
  switch (*at_) {
  case ':':
    if (startsBlock() && at_ + 1 < end_ && isNumberDigit(at_[1])) {
      ++at_;
      block_.mainBlock = true;
      return scanNumberOfBlock(begin);
    }
    break;
  case '"':
    if (startsBlock()) {
      Item item = itemAt(ItemKind::Call, begin);
      if (const auto name = scanString())
        scanCall(*name, item);
      return;
    }
    break;
  case '$':
    return scanAssignment(begin);
  case '(': {
    // A comment of another control: what it holds is not code.
    while (!atLineEnd() && *at_ != ')')
      ++at_;
    if (at_ < end_ && *at_ == ')')
      ++at_;
    return issue(SyntaxIssueKind::ForeignComment, begin, at_);
  }
  case ')':
  case ']':
  case '[':
    ++at_;
    return issue(*begin == ')' ? SyntaxIssueKind::StrayParenthesis
                               : SyntaxIssueKind::UnbalancedBracket,
                 begin, at_);
  case '#': {
    ++at_;
    while (at_ < end_ && (isNumberDigit(*at_) || *at_ == '=' || *at_ == '.' || *at_ == '-'))
      ++at_;
    return issue(SyntaxIssueKind::SymbolAsAddress, begin, at_);
  }
  case '/':
    ++at_;
    while (at_ < end_ && isNumberDigit(*at_))
      ++at_;
    return issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
  default:
    break;
  }
  if (isNumberDigit(*at_) || *at_ == '.' || *at_ == '-' || *at_ == '+') {
    skipNumberCharacters();
    return issue(SyntaxIssueKind::MissingAddress, begin, at_);
  }
  ++at_;
  while (at_ < end_ && (uint8_t(*at_) >= 128 || *at_ == *begin))
    ++at_;
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

/// What stands between two quotes, the first of which is at hand; none, with an issue, without the
/// second one.
std::optional<llvm::StringRef> Scanner::scanString() {
  const char *const begin = at_++;
  while (!atLineEnd() && *at_ != '"')
    ++at_;
  if (atLineEnd()) {
    issue(SyntaxIssueKind::UnclosedString, begin, at_);
    return std::nullopt;
  }
  const llvm::StringRef inside(begin + 1, size_t(at_ - begin - 1));
  ++at_;
  return inside;
}

/// `NAME:` in front of everything but the number.
bool Scanner::scanLabel() {
  if (!startsBlock() || block_.hasLabel())
    return false;
  const llvm::StringRef name = identifier();
  if (name.end() == end_ || *name.end() != ':')
    return false;
  block_.labelBegin = offset(name.begin());
  block_.labelEnd = offset(name.end());
  at_ = name.end() + 1;
  return true;
}

void Scanner::scanNumberOfBlock(const char *begin) {
  setNumber(begin, takeWhole());
  if (at_ < end_ && *at_ == '.') {
    while (at_ < end_ && (isNumberDigit(*at_) || *at_ == '.'))
      ++at_;
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  }
}

void Scanner::addExpression(AddressId address, const char *begin, uint16_t expression,
                            WordReading reading) {
  Word word;
  word.address = address;
  word.flags = wordExpression;
  word.decimals = uint8_t(reading);
  word.mantissa = expression;
  addWord(word, begin);
}

/// A letter and its number, or what else begins with a letter.
void Scanner::scanLetter() {
  const char *const begin = at_;
  const char letter = char(*at_ & ~32);
  const char *const next = at_ + 1;
  if (next < end_ && isNameLetter(*next))
    return scanName();
  if (next < end_ && isNumberDigit(*next) && startsBlock()) {
    // `N10` in front, `L10` a program's name, `R1=` a variable; all of them may be a label.
    if (letter == 'N' && block_.number < 0) {
      ++at_;
      return scanNumberOfBlock(begin);
    }
    if (scanLabel())
      return;
    if (letter == 'L') {
      Item item = itemAt(ItemKind::Call, begin);
      const llvm::StringRef name = identifier();
      if (llvm::all_of(name.drop_front(), isNumberDigit) && !isEquals(behindBlanks(name.end()))) {
        at_ = name.end();
        return scanCall(name, item);
      }
    }
  }
  if (letter == 'R' && next < end_ && (isNumberDigit(*next) || *next == '['))
    return scanAssignment(begin);
  ++at_;
  const AddressId address = letterAddress(letter);
  if (at_ < end_ && (isNumberDigit(*at_) || *at_ == '-')) {
    Word word;
    word.address = address;
    if (const char *const behind = readPlainNumber(at_, end_, word)) {
      if (behind < end_ && *behind == '=' && isEquals(behind) && word.isWhole() &&
          !word.has(wordMinus)) {
        at_ = begin;
        return scanExtended(letter, begin);
      }
      // An exponent is part of the number.
      if (!(behind + 1 < end_ && (behind[0] | 32) == 'e' && (behind[1] | 32) == 'x')) {
        at_ = behind;
        return addWord(word, begin);
      }
    }
  }
  const char *const value = behindBlanks(at_);
  if (isEquals(value)) {
    at_ = value + 1;
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
    Word word;
    word.address = address;
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
    return addWord(word, begin);
  }
  Word word;
  word.address = address;
  word.flags = wordNoValue;
  issue(SyntaxIssueKind::MissingValue, begin, at_);
  addWord(word, begin);
}

/// `X1=10`, `S2=500`, `M1=3`, `I1=5`: the number belongs to the address.
void Scanner::scanExtended(char letter, const char *begin) {
  ++at_;
  const llvm::StringRef digits = llvm::StringRef(at_, size_t(end_ - at_)).take_while(isNumberDigit);
  at_ = digits.end() + 1; // behind the `=`
  const auto named = addresses_.find(llvm::StringRef(begin, digits.size() + 1).upper());
  if (named != addresses_.end())
    return scanValue(named->second, begin);
  // The first spindle is the one that words without a number speak of.
  if ((letter == 'S' || letter == 'M') && digits == "1")
    return scanValue(letterAddress(letter), begin);
  if (letter == 'S' || letter == 'M' || letter == 'T' || letter == 'D' || letter == 'H' ||
      letter == 'L') {
    Item item = itemAt(ItemKind::Assignment, begin);
    item.nameBegin = item.begin;
    item.nameEnd = offset(digits.end());
    item.target = constant(begin, digits.end(), double(variableKey({begin, digits.size() + 1})));
    item.value = expression();
    return add(item);
  }
  // An axis of the machine: where it goes says nothing of the workpiece's axes.
  const uint16_t value = expression();
  if (value < block_.expressions.size() && !block_.expressions[value].bad) {
    block_.operations.push_back({Op::Opaque, offset(begin), 1});
    ++block_.expressions[value].count;
  }
  addExpression(letterAddress(letter), begin, value);
}

/// What stands behind `=`: most often a plain number.
void Scanner::scanValue(AddressId address, const char *begin) {
  skipBlanks();
  if (at_ < end_ && (isNumberDigit(*at_) || *at_ == '-')) {
    Word word;
    word.address = address;
    if (const char *const behind = readPlainNumber(at_, end_, word)) {
      const char *const next = behindBlanks(behind);
      const bool ends = next == end_ || isLineEnd(*next) || *next == ';' ||
                        (isNameLetter(*next) && next > behind) ||
                        (isLetter(*next) && next + 1 < end_ && !isNameLetter(next[1]));
      const llvm::StringRef word2 =
          llvm::StringRef(next, size_t(end_ - next)).take_while(isNameCharacter);
      if (ends && !word2.equals_insensitive("DIV") && !word2.equals_insensitive("MOD") &&
          !word2.startswith_insensitive("B_")) {
        at_ = behind;
        return addWord(word, begin);
      }
    }
  }
  if (atBlockEnd()) {
    Word word;
    word.address = address;
    word.flags = wordNoValue;
    issue(SyntaxIssueKind::MissingValue, begin, at_);
    return addWord(word, begin);
  }
  WordReading reading;
  const uint16_t index = parsed(&SinumerikExpression::parseValue, reading);
  addExpression(address, begin, index, reading);
}

/// `M[R1]=3`, `AX[_OSA]=5`, `FL[X]=100`, `POS[Y]=20`.
void Scanner::scanIndexed(const char *begin, AddressId address) {
  const char *p = behindBlanks(at_);
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
  at_ = behindBlanks(p + 1);
  if (!isEquals(at_)) {
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

/// A number that is not as usual; false, with an issue, when there is no digit in it.
bool Scanner::scanNumber(Word &word, const char *begin) {
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

/// Two letters and more: a keyword, an address with `=`, a variable, a code, a call.
void Scanner::scanName() {
  const char *const begin = at_;
  if (scanLabel())
    return;
  const llvm::StringRef name = identifier();
  if (const Keyword keyword = keywordOf(name); keyword != Keyword::None) {
    at_ = name.end();
    return scanStatement(keyword, begin);
  }
  const char *const behind = behindBlanks(name.end());
  const auto address = addresses_.find(name.upper());
  if (address != addresses_.end()) {
    at_ = name.end();
    if (isEquals(behind)) {
      at_ = behind + 1;
      return scanValue(address->second, begin);
    }
    if (behind < end_ && *behind == '[')
      return scanIndexed(begin, address->second);
    issue(SyntaxIssueKind::MissingEquals, begin, at_);
    at_ = behind;
    if (!atBlockEnd() && (isNumberDigit(*at_) || *at_ == '-' || *at_ == '(' || *at_ == '.'))
      return scanValue(address->second, begin);
    return;
  }
  if (isEquals(behind))
    return scanAssignment(begin);
  if (behind < end_ && *behind == '[') {
    at_ = name.end();
    return scanIndexed(begin, noAddress);
  }
  if (const CodeIndex code = dialect_.keyword(name); code != noCode)
    return scanCode(code, name);
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
  // `XR1`: a variable behind its address, without the `=`.
  if (name.size() > 2 && (name[1] | 32) == 'r' && isLetter(name[0]) &&
      llvm::all_of(name.drop_front(2), isNumberDigit)) {
    issue(SyntaxIssueKind::MissingEquals, begin, name.end());
    at_ = begin + 1;
    return scanValue(letterAddress(char(*begin & ~32)), begin);
  }
  Item item = itemAt(ItemKind::Call, begin);
  at_ = name.end();
  scanCall(name, item);
}

/// A word that is a code by itself, perhaps with arguments.
void Scanner::scanCode(CodeIndex code, llvm::StringRef name) {
  at_ = name.end();
  Word word;
  word.address = keywordAddress;
  word.mantissa = code;
  addWord(word, name.begin());
  const char *const behind = behindBlanks(at_);
  if (behind == end_ || *behind != '(')
    return;
  at_ = behind;
  Item item = itemAt(ItemKind::Instruction, name.begin());
  item.nameBegin = item.begin;
  item.nameEnd = offset(name.end());
  scanArguments(item, /*words=*/true);
  add(item);
}

/// A call of program `name`, which stands in front: arguments and passes.
void Scanner::scanCall(llvm::StringRef name, Item &item) {
  nameItem(item, name);
  const char *behind = behindBlanks(at_);
  if (behind < end_ && *behind == '(') {
    at_ = behind;
    scanArguments(item, /*words=*/false);
    behind = behindBlanks(at_);
  }
  if (behind + 1 < end_ && (*behind | 32) == 'p') {
    const char *const value = behindBlanks(behind + 1);
    if (value < end_ && (isNumberDigit(*value) || *value == '-' || isEquals(value))) {
      at_ = value + (*value == '=');
      item.count = expression();
    }
  }
  add(item);
}

/// `(a, b,, "c")`
void Scanner::scanArguments(Item &item, bool words) {
  ++at_; // the parenthesis
  const char *const begin = base_ + item.begin;
  skipBlanks();
  if (at_ < end_ && *at_ == ')') {
    ++at_;
    return;
  }
  for (char separator = 0;; separator = ',') {
    scanArgument(item, separator, words);
    skipBlanks();
    if (at_ < end_ && *at_ == ')') {
      ++at_;
      return;
    }
    if (at_ == end_ || *at_ != ',')
      break;
    ++at_;
  }
  // What follows can be no argument: the list ends here, or the rest of the block is lost.
  const char *p = at_;
  while (p < end_ && !isLineEnd(*p) && *p != ';' && *p != ')')
    ++p;
  if (p < end_ && *p == ')') {
    issue(SyntaxIssueKind::BadExpression, at_, p);
    at_ = p + 1;
    return;
  }
  issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
}

void Scanner::scanArgument(Item &item, char separator, bool words) {
  skipBlanks();
  const char *begin = at_;
  Argument argument;
  argument.separator = separator;
  Word word;
  word.address = argumentAddress;
  if (const llvm::StringRef name = identifier(); !name.empty() && !isNumberDigit(name[0])) {
    // A name in front of the value.
    const char *const behind = behindBlanks(name.end());
    if (isEquals(behind)) {
      issue(SyntaxIssueKind::NamedArgument, begin, behind + 1);
      at_ = behind + 1;
      skipBlanks();
      begin = at_;
    }
  }
  argument.begin = argument.end = offset(begin);
  if (at_ == end_ || isLineEnd(*at_) || *at_ == ',' || *at_ == ')' || *at_ == ';') {
    word.flags = wordNoValue;
  } else if (*at_ == '"') {
    if (const auto text = scanString()) {
      const char *const next = behindBlanks(at_);
      if (next < end_ && (*next == ',' || *next == ')')) {
        argument.kind = ArgumentKind::Text;
        argument.begin = offset(text->begin());
        argument.end = offset(text->end());
      } else { // a string that is put together
        at_ = begin;
        argument.kind = ArgumentKind::Expression;
        argument.expression = expression();
        argument.end = offset(at_);
      }
    }
    word.flags = wordExpression;
    word.mantissa = opaque(begin, at_);
  } else {
    const char *const behind = (isNumberDigit(*at_) || *at_ == '-') && words
                                   ? readPlainNumber<true>(at_, end_, word)
                                   : nullptr;
    const char *const next = behind ? behindBlanks(behind) : nullptr;
    argument.kind = ArgumentKind::Expression;
    if (next && next < end_ && (*next == ')' || *next == ',')) {
      at_ = behind;
      argument.expression = constant(begin, behind, word.value());
    } else {
      const size_t issues = block_.issues.size();
      argument.expression = expression();
      word = Word();
      word.address = argumentAddress;
      word.flags = wordExpression;
      word.mantissa = argument.expression;
      if (block_.issues.size() > issues && at_ == begin)
        ++at_;
    }
    argument.end = offset(at_);
  }
  block_.arguments.push_back(argument);
  ++item.arguments;
  if (words)
    addWord(word, begin);
}

/// `R1=..`, `NAME=..`, `FIELD[1]=..`, `$TC_DP6[1,1]=..`
void Scanner::scanAssignment(const char *begin) {
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
  item.value = expression();
  add(item);
}

void Scanner::structure(Structure structure, const char *begin, uint16_t condition) {
  Item item = itemAt(ItemKind::Structure, begin);
  item.structure = structure;
  item.condition = condition;
  add(item);
}

void Scanner::scanStatement(Keyword keyword, const char *begin) {
  switch (keyword) {
  case Keyword::If:
    return scanIf(begin);
  case Keyword::Else:
    return structure(Structure::Else, begin);
  case Keyword::EndIf:
    return structure(Structure::EndIf, begin);
  case Keyword::Loop:
    return structure(Structure::Loop, begin);
  case Keyword::EndLoop:
    return structure(Structure::EndLoop, begin);
  case Keyword::EndFor:
    return structure(Structure::EndFor, begin);
  case Keyword::EndWhile:
    return structure(Structure::EndWhile, begin);
  case Keyword::While:
  case Keyword::Until: {
    const uint16_t test = condition();
    return structure(keyword == Keyword::While ? Structure::While : Structure::Until, begin, test);
  }
  case Keyword::For:
    return scanFor(begin);
  case Keyword::Repeat:
  case Keyword::RepeatBlock:
    return scanRepeat(keyword == Keyword::RepeatBlock, begin);
  case Keyword::Goto:
  case Keyword::GotoForward:
  case Keyword::GotoBackward:
  case Keyword::GotoIfFound:
  case Keyword::GotoStart:
    return scanJump(keyword, begin);
  case Keyword::Case:
    return scanCase(begin);
  case Keyword::Def:
    return scanDefinitions();
  case Keyword::Proc:
    return scanParameters(ItemKind::Parameters, begin);
  case Keyword::Extern:
    return scanParameters(ItemKind::Declaration, begin);
  case Keyword::Define:
    return scanMacro(begin);
  case Keyword::ModalCall:
    return scanModalCall(begin, {begin, size_t(at_ - begin)});
  case Keyword::Call:
  case Keyword::PathCall:
  case Keyword::ExternalCall:
    return scanIndirectCall(keyword, begin);
  case Keyword::None:
    break;
  }
}

/// A jump follows behind the condition, or the blocks to ENDIF.
void Scanner::scanIf(const char *begin) {
  const uint16_t test = condition();
  skipBlanks();
  if (!isJump(keywordOf(identifier())))
    return structure(Structure::If, begin, test);
  Item item = itemAt(ItemKind::If, begin);
  item.condition = test;
  add(item);
  const char *const jump = at_;
  const llvm::StringRef name = identifier();
  at_ = name.end();
  scanJump(keywordOf(name), jump);
}

void Scanner::scanJump(Keyword keyword, const char *begin) {
  Item item = itemAt(ItemKind::Jump, begin);
  item.jump = keyword == Keyword::GotoForward    ? JumpKind::Forward
              : keyword == Keyword::GotoBackward ? JumpKind::Backward
              : keyword == Keyword::GotoIfFound  ? JumpKind::IfFound
              : keyword == Keyword::GotoStart    ? JumpKind::ToStart
                                                 : JumpKind::Anywhere;
  if (keyword != Keyword::GotoStart)
    scanTarget(item);
  add(item);
}

/// A label, `N100`, `:10`, `10`, or a string that only the run puts together.
void Scanner::scanTarget(Item &item) {
  skipBlanks();
  Argument target;
  target.begin = target.end = offset(at_);
  const char *const begin = at_;
  const llvm::StringRef name = identifier();
  const char *digits = at_;
  if (at_ < end_ && (*at_ == ':' || ((*at_ | 32) == 'n' && name.size() > 1 &&
                                     llvm::all_of(name.drop_front(), isNumberDigit))))
    ++digits;
  if (digits < end_ && isNumberDigit(*digits)) {
    at_ = digits;
    const auto number = double(takeWhole());
    target.kind = ArgumentKind::BlockNumber;
    target.expression = constant(begin, at_, number);
  } else if (!name.empty() &&
             !llvm::StringRef(behindBlanks(name.end()), size_t(end_ - behindBlanks(name.end())))
                  .startswith("<<")) {
    target.kind = ArgumentKind::Label;
    at_ = name.end();
  } else if (!atBlockEnd() && (*at_ == '"' || *at_ == '(' || *at_ == '$' || !name.empty())) {
    target.kind = ArgumentKind::Expression;
    target.expression = expression();
    block_.expressions[target.expression].bad = true; // a name, not a number
  } else {
    issue(SyntaxIssueKind::BadStatement, base_ + item.begin, at_);
  }
  target.end = offset(at_);
  block_.arguments.push_back(target);
  ++item.arguments;
}

/// `CASE(R1) OF 1 GOTOF A 2 GOTOF B DEFAULT GOTOF C`
void Scanner::scanCase(const char *begin) {
  Item item = itemAt(ItemKind::Jump, begin);
  item.jump = JumpKind::ByValue;
  item.condition = expression();
  item.firstArgument = uint16_t(block_.arguments.size());
  skipBlanks();
  if (identifier().equals_insensitive("OF"))
    at_ = identifier().end();
  else
    issue(SyntaxIssueKind::BadStatement, begin, at_);
  for (;;) {
    skipBlanks();
    if (atBlockEnd())
      break;
    const bool last = identifier().equals_insensitive("DEFAULT");
    if (last) {
      at_ = identifier().end();
    } else {
      Argument value;
      value.kind = ArgumentKind::Expression;
      value.begin = offset(at_);
      const char *const before = at_;
      value.expression = expression();
      value.end = offset(at_);
      if (at_ == before)
        break;
      block_.arguments.push_back(value);
      ++item.arguments;
    }
    skipBlanks();
    const Keyword jump = keywordOf(identifier());
    if (!isJump(jump)) {
      issue(SyntaxIssueKind::BadStatement, begin, at_);
      rest();
      if (item.arguments % 2 && !last) {
        block_.arguments.pop_back();
        --item.arguments;
      }
      break;
    }
    at_ = identifier().end();
    scanTarget(item);
    if (last)
      break;
  }
  if (!item.arguments)
    issue(SyntaxIssueKind::BadStatement, begin, at_);
  add(item);
}

/// `FOR I=1 TO 5`
void Scanner::scanFor(const char *begin) {
  Item item = itemAt(ItemKind::Structure, begin);
  item.structure = Structure::For;
  skipBlanks();
  item.nameBegin = offset(at_);
  item.target = parsed(&SinumerikExpression::parseTarget);
  item.nameEnd = offset(at_);
  skipBlanks();
  bool good = isEquals(at_);
  if (good) {
    ++at_;
    item.value = expression();
    skipBlanks();
    good = identifier().equals_insensitive("TO");
  }
  if (good) {
    at_ = identifier().end();
    item.limit = expression();
  } else {
    issue(SyntaxIssueKind::BadStatement, begin, at_);
    rest();
  }
  add(item);
}

/// `REPEAT` alone begins a loop; with labels it runs a section again.
void Scanner::scanRepeat(bool single, const char *begin) {
  skipBlanks();
  if (atBlockEnd() && !single)
    return structure(Structure::Repeat, begin);
  Item item = itemAt(ItemKind::Repeat, begin);
  item.single = single;
  item.jump = single ? JumpKind::Anywhere : JumpKind::Backward;
  while (!atBlockEnd()) {
    const llvm::StringRef name = identifier();
    const char *const behind = behindBlanks(name.end());
    const bool passes = name.size() >= 1 && (name[0] | 32) == 'p' &&
                        (name.size() == 1 || llvm::all_of(name.drop_front(), isNumberDigit)) &&
                        (name.size() > 1 || isEquals(behind));
    if (passes) {
      at_ = name.size() > 1 ? name.begin() + 1 : behind + 1;
      item.count = expression();
      break;
    }
    if (name.empty() || isNumberDigit(name[0]))
      break;
    Argument label;
    label.kind = ArgumentKind::Label;
    label.begin = offset(name.begin());
    label.end = offset(name.end());
    if (item.arguments)
      label.separator = ' ';
    block_.arguments.push_back(label);
    ++item.arguments;
    at_ = name.end();
    skipBlanks();
  }
  if (item.arguments > 1)
    item.jump = JumpKind::Anywhere;
  if (!item.arguments)
    issue(SyntaxIssueKind::BadStatement, begin, at_);
  add(item);
}

/// `DEF INT A=0, B[3]`
void Scanner::scanDefinitions() {
  skipBlanks();
  const char *const begin = at_;
  VariableType type = VariableType::None;
  // Modifiers (NCK, CHAN, SYNR, PHU 3, …) may stand in front of the type.
  while (!atBlockEnd() && type == VariableType::None) {
    const llvm::StringRef word = identifier();
    if (word.empty())
      break;
    at_ = word.end();
    type = typeOf(word);
    if (type == VariableType::String) {
      skipBlanks();
      skipIndices();
    }
    skipBlanks();
  }
  if (type == VariableType::None) {
    issue(SyntaxIssueKind::BadStatement, begin, at_);
    return rest();
  }
  while (!atBlockEnd()) {
    const llvm::StringRef name = identifier();
    if (name.empty() || isNumberDigit(name[0])) {
      issue(SyntaxIssueKind::BadStatement, begin, at_);
      return rest();
    }
    Item item = itemAt(ItemKind::Definition, at_);
    item.type = type;
    nameItem(item, name);
    item.target = constant(name.begin(), name.end(), double(variableKey(name)));
    at_ = name.end();
    skipBlanks();
    if (at_ < end_ && *at_ == '[') {
      for (char separator = 0; at_ < end_ && (*at_ == '[' || *at_ == ',');) {
        ++at_;
        Argument size;
        size.kind = ArgumentKind::Expression;
        size.separator = separator;
        size.begin = offset(at_);
        size.expression = expression();
        size.end = offset(at_);
        separator = ',';
        block_.arguments.push_back(size);
        ++item.arguments;
        skipBlanks();
      }
      if (at_ < end_ && *at_ == ']')
        ++at_;
      else
        issue(SyntaxIssueKind::UnbalancedBracket, name.begin(), at_);
      skipBlanks();
    }
    if (isEquals(at_)) {
      ++at_;
      item.value = expression();
      skipBlanks();
    }
    add(item);
    if (at_ == end_ || *at_ != ',')
      break;
    ++at_;
    skipBlanks();
  }
  skipBlanks();
  if (!atBlockEnd()) {
    issue(SyntaxIssueKind::BadStatement, at_, at_ + 1);
    rest();
  }
}

/// `PROC NAME(REAL A, INT B=1, VAR REAL C) SAVE`, `EXTERN NAME(REAL, VAR INT)`
void Scanner::scanParameters(ItemKind kind, const char *begin) {
  Item item = itemAt(kind, begin);
  skipBlanks();
  const llvm::StringRef name = identifier();
  nameItem(item, name);
  at_ = name.end();
  if (name.empty()) {
    issue(SyntaxIssueKind::BadStatement, begin, at_);
    rest();
    return add(item);
  }
  skipBlanks();
  if (at_ < end_ && *at_ == '(') {
    ++at_;
    skipBlanks();
    for (char separator = 0; !atBlockEnd() && *at_ != ')'; separator = ',') {
      Argument parameter;
      parameter.kind = ArgumentKind::Name;
      parameter.separator = separator;
      const char *const from = at_;
      if (identifier().equals_insensitive("VAR")) {
        parameter.byReference = true;
        at_ = identifier().end();
        skipBlanks();
      }
      parameter.type = typeOf(identifier());
      at_ = identifier().end();
      skipBlanks();
      skipIndices(); // STRING[20]
      skipBlanks();
      const llvm::StringRef own = identifier();
      parameter.begin = offset(own.begin());
      parameter.end = offset(own.end());
      at_ = own.end();
      skipBlanks();
      skipIndices();
      skipBlanks();
      if (isEquals(at_)) {
        ++at_;
        parameter.expression = expression();
        skipBlanks();
      }
      block_.arguments.push_back(parameter);
      ++item.arguments;
      if (parameter.type == VariableType::None)
        issue(SyntaxIssueKind::BadStatement, from, std::max(from + 1, at_));
      if (at_ == from || at_ == end_ || *at_ != ',')
        break;
      ++at_;
      skipBlanks();
    }
    if (at_ < end_ && *at_ == ')')
      ++at_;
    else
      issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
  }
  // Attributes; only SAVE matters to the caller.
  while (!atBlockEnd()) {
    const llvm::StringRef attribute = identifier();
    if (attribute.empty()) {
      ++at_;
      continue;
    }
    item.restores |= attribute.equals_insensitive("SAVE");
    at_ = attribute.end();
  }
  add(item);
}

/// `DEFINE NAME AS G1 G91`: what it stands for is read where it is written only.
void Scanner::scanMacro(const char *begin) {
  Item item = itemAt(ItemKind::Macro, begin);
  skipBlanks();
  const llvm::StringRef name = identifier();
  nameItem(item, name);
  at_ = name.end();
  rest();
  add(item);
}

/// `MCALL`, `MCALL CYCLE81(..)`, `MCALL HOLE(..)`
void Scanner::scanModalCall(const char *begin, llvm::StringRef name) {
  scanCode(dialect_.keyword(name), name);
  skipBlanks();
  if (atBlockEnd())
    return;
  const llvm::StringRef called = identifier();
  const char *const behind = behindBlanks(called.end());
  const bool isProgram = called.size() > 1 && dialect_.keyword(called) == noCode &&
                         keywordOf(called) == Keyword::None && !isEquals(behind) &&
                         (isNameLetter(called[1]) || (called[0] | 32) == 'l');
  if (!isProgram)
    return;
  Item item = itemAt(ItemKind::Call, begin);
  item.modal = true;
  at_ = called.end();
  scanCall(called, item);
}

/// `CALL "NAME"`, `CALL VARIABLE`, `PCALL /_N_SPF_DIR/NAME(..)`, `EXTCALL("NAME")`
void Scanner::scanIndirectCall(Keyword keyword, const char *begin) {
  Item item = itemAt(ItemKind::Call, begin);
  item.external = keyword == Keyword::ExternalCall;
  skipBlanks();
  const bool bracket = at_ < end_ && *at_ == '(';
  const char *const open = bracket ? behindBlanks(at_ + 1) : at_;
  if (open < end_ && *open == '"') {
    at_ = open;
    const auto name = scanString();
    if (!name)
      return;
    skipBlanks();
    if (bracket && at_ < end_ && *at_ == ')')
      ++at_;
    if (!identifier().equals_insensitive("BLOCK"))
      return scanCall(*name, item);
    item.external = true;
    rest();
    return scanCall(*name, item);
  }
  if (keyword == Keyword::PathCall) {
    const char *p = at_;
    while (p < end_ && !isBlank(*p) && !isLineEnd(*p) && *p != '(' && *p != ';')
      ++p;
    const llvm::StringRef path(at_, size_t(p - at_));
    at_ = p;
    return scanCall(path, item);
  }
  if (identifier().equals_insensitive("BLOCK")) { // labels of this program
    item.external = true;
    item.value = opaque(at_, identifier().end());
    rest();
    return add(item);
  }
  item.external |= bracket;
  item.value = expression();
  rest();
  add(item);
}

} // namespace

SinumerikReader::SinumerikReader(const Dialect &dialect, llvm::StringRef text)
    : Reader(text), dialect_(dialect) {
  for (size_t i = 0; i < dialect.addressNames.size(); ++i)
    addresses_[llvm::StringRef(dialect.addressNames[i]).upper()] = AddressId(firstNamed + i);
}

void SinumerikReader::read(uint32_t offset, Block &block) const {
  block.clear();
  Scanner(dialect_, addresses_, text_, offset, block).scan();
}

} // namespace ncvet
