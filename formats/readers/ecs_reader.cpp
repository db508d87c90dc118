// Reader of ECS programs: words, instructions and variables in angle brackets, labels, expressions.
#include "formats/readers/ecs_reader.h"

#include "formats/readers/block_scanner.h"
#include "formats/readers/ecs_expression.h"
#include "formats/readers/plain_number.h"

#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"

#include <algorithm>

namespace ncvet {

namespace {

bool isLetter(char c) { return uint8_t((c | 32) - 'a') < 26; }
bool isNameCharacter(char c) { return isLetter(c) || isNumberDigit(c); }

/// Bytes of a typographic quotation mark in UTF-8: U+2018 to U+201E; 0: none. `comment` says
/// whether it stands for the one that opens a comment.
unsigned typographicQuote(const char *at, const char *end, bool &comment) {
  if (end - at < 3 || uint8_t(at[0]) != 0xE2 || uint8_t(at[1]) != 0x80)
    return 0;
  const auto third = uint8_t(at[2]);
  comment = third == 0x98 || third == 0x99 || third == 0x9B;
  return third >= 0x98 && third <= 0x9E ? 3 : 0;
}

/// The name of a program, where its folder may stand in front and blanks behind.
llvm::StringRef withoutFolder(llvm::StringRef path) {
  path = path.rtrim();
  const size_t slash = path.find_last_of("\\/");
  return slash == llvm::StringRef::npos ? path : path.drop_front(slash + 1);
}

class Scanner : BlockScanner<> {
public:
  Scanner(const Dialect &dialect, const llvm::StringMap<AddressId> &addresses, llvm::StringRef text,
          uint32_t offset, Block &block)
      : BlockScanner(text, offset, block), dialect_(dialect), addresses_(addresses) {}

  void scan();

private:
  bool startsBlock() const { return block_.words.empty() && block_.items.empty(); }
  llvm::StringRef name() const {
    const char *p = at_;
    while (p < end_ && *p == '%' && p - at_ < 2)
      ++p;
    while (p < end_ && isNameCharacter(*p))
      ++p;
    return {at_, size_t(p - at_)};
  }

  void scanItem();
  void scanLineComment(unsigned mark);
  void scanComment(char close);
  void scanLabel();
  void scanReset();
  void scanPhase();
  void scanLetter();
  void scanPlane(const char *begin);
  void scanValue(AddressId address, const char *begin);
  bool scanNumber(Word &word, const char *begin);
  void scanAssignment(const char *begin);
  void scanElement(const char *begin);
  void scanCall(const char *begin);
  void scanOther();

  void scanAngle();
  void closeAngle(const char *begin);
  void skipToAngle() {
    while (!atLineEnd() && *at_ != '>')
      ++at_;
  }
  /// Whether an argument ends at `p`.
  bool endsArgument(const char *p) const {
    return p == end_ || isLineEnd(*p) || *p == '>' || *p == ';' || *p == ',';
  }
  /// The expression that `word` has goes on to here.
  void extendExpression(const Word &word) {
    if (word.has(wordExpression) && size_t(word.mantissa) < block_.expressions.size()) {
      uint32_t &end = block_.expressions[size_t(word.mantissa)].end;
      end = std::max(end, offset(at_));
    }
  }
  void scanVariable(const char *begin, llvm::StringRef name);
  void scanInstruction(const char *begin, llvm::StringRef name);
  void scanOtherProgram(Item &item, const char *begin);
  void tooManyArguments(const char *begin);
  void scanJump(const char *begin, bool other);
  void scanChoice(const char *begin, bool other);
  void missingColon(const char *begin);
  void scanRepeat(const char *begin);
  void scanInput(const char *begin);
  Argument scanTarget(char separator);
  Argument scanArgument(char separator, bool named = false);
  char scanSeparator();
  llvm::StringRef scanProgramName();
  void scanString(Argument &argument);
  void keyword(CodeIndex code, const char *begin, const char *end);
  void argumentWord(const Argument &argument);
  llvm::SmallVector<Argument, 8> inOrder(llvm::ArrayRef<Argument> written, const CodeInfo &code);

  uint16_t expression() { return parsed(&EcsExpression::parse); }
  /// `<expr>`; the bracket is at hand.
  uint16_t bracketed() {
    const char *const begin = at_++;
    const uint16_t index = expression();
    closeAngle(begin);
    return index;
  }
  void add(Item &item) {
    item.arguments = uint16_t(block_.arguments.size() - item.firstArgument);
    BlockScanner::add(item);
  }

  const Dialect &dialect_;
  const llvm::StringMap<AddressId> &addresses_;
};

void Scanner::scan() {
  block_.begin = offset(at_);
  const char *content = at_;
  while (at_ < end_ && !isLineEnd(*at_)) {
    if (isLineBlank(*at_)) {
      ++at_;
      continue;
    }
    scanItem();
    content = at_;
  }
  block_.end = offset(content);
  takeLineEnd();
  if (block_.isEmpty() && block_.issues.empty() && block_.number < 0 && block_.skip < 0 &&
      !block_.hasLabel())
    block_.kind = BlockKind::Empty;
}

void Scanner::scanItem() {
  const char c = *at_;
  if (isLetter(c))
    return scanLetter();
  bool comment = false;
  switch (c) {
  case '<':
    return scanAngle();
  case '(':
    return scanComment(')');
  case '{':
    return scanComment('}');
  case '\'':
    return scanLineComment(1);
  case '[':
    return scanLabel();
  case '%':
    if (startsBlock())
      return scanReset();
    break;
  case ':':
    if (startsBlock())
      return scanPhase();
    break;
  case '/':
    ++at_;
    if (startsBlock() && block_.skip < 0) {
      block_.skip = 0;
      return;
    }
    return issue(SyntaxIssueKind::InvalidCharacter, at_ - 1, at_);
  case '#':
    if (at_ + 1 < end_ && isNumberDigit(at_[1]))
      return scanAssignment(at_);
    break;
  default:
    if (const unsigned mark = typographicQuote(at_, end_, comment); mark && comment)
      return scanLineComment(mark);
  }
  scanOther();
}

/// To the end of the line.
void Scanner::scanLineComment(unsigned mark) {
  const char *const begin = at_;
  if (mark > 1)
    issue(SyntaxIssueKind::TypographicQuote, begin, begin + mark);
  at_ = lineEnd();
  block_.comments.push_back({offset(begin), offset(at_)});
}

void Scanner::scanComment(char close) {
  const char *const begin = at_;
  const char *const line = lineEnd();
  while (at_ < line && *at_ != close)
    ++at_;
  if (at_ == line)
    issue(SyntaxIssueKind::UnclosedComment, begin, at_);
  else if (const llvm::StringRef inside(begin + 1, size_t(at_++ - begin - 1));
           inside.contains(*begin))
    issue(SyntaxIssueKind::NestedComment, begin + 1 + inside.find(*begin), at_);
  block_.comments.push_back({offset(begin), offset(at_), close == ')'});
}

void Scanner::scanLabel() {
  const char *const begin = at_++;
  const char *const line = lineEnd();
  const char *const text = at_;
  while (at_ < line && *at_ != ']')
    ++at_;
  const bool misplaced = !startsBlock() || block_.hasLabel();
  if (at_ == line)
    return issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
  if (misplaced) {
    ++at_;
    return issue(SyntaxIssueKind::MisplacedLabel, begin, at_);
  }
  block_.labelBegin = offset(text);
  block_.labelEnd = offset(at_++);
  if (block_.labelBegin == block_.labelEnd)
    issue(SyntaxIssueKind::BadStatement, begin, at_);
}

/// `%`: what follows on the line is a remark.
void Scanner::scanReset() {
  const char *const begin = at_++;
  if (const CodeIndex code = dialect_.keyword("%"); code != noCode)
    keyword(code, begin, at_);
  skipBlanks();
  if (atLineEnd())
    return;
  const char *const remark = at_;
  at_ = lineEnd();
  block_.comments.push_back({offset(remark), offset(at_)});
}

/// `:N10` or `:10`
void Scanner::scanPhase() {
  const char *const begin = at_++;
  skipBlanks();
  if (at_ < end_ && (*at_ | 32) == 'n')
    ++at_;
  const char *const digits = at_;
  const int64_t number = takeWhole();
  if (at_ == digits)
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  setNumber(begin, number);
  block_.mainBlock = true;
  if (const CodeIndex code = dialect_.keyword(":N"); code != noCode)
    keyword(code, begin, at_);
}

void Scanner::keyword(CodeIndex code, const char *begin, const char *end) {
  Word word;
  word.address = keywordAddress;
  word.mantissa = code;
  const char *const at = at_;
  at_ = end;
  addWord(word, begin);
  at_ = at;
}

void Scanner::scanLetter() {
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
    const llvm::StringRef run =
        llvm::StringRef(begin, size_t(end_ - begin)).take_while([](char c) { return isLetter(c); });
    // Bare axes (`G23 XYZ`) and K stand without values; other runs of letters mean nothing.
    if (run.size() > 2 &&
        run.find_first_not_of("XYZABCUVWKDxyzabcuvwkd") != llvm::StringRef::npos) {
      at_ = run.end();
      while (at_ < end_ && isNameCharacter(*at_))
        ++at_;
      return issue(SyntaxIssueKind::UnknownWord, begin, at_);
    }
  }
  const AddressId address = letterAddress(letter);
  const bool digit = next < end_ && isNumberDigit(*next);
  switch (letter) {
  case 'N':
    if (next + 1 < end_ && (*next == '-' || *next == '+') && isNumberDigit(next[1]) &&
        startsBlock() && block_.number < 0) {
      for (at_ = next + 1; at_ < end_ && (isNumberDigit(*at_) || *at_ == '.');)
        ++at_;
      setNumber(begin, 0);
      return issue(SyntaxIssueKind::MalformedNumber, begin, at_);
    }
    if (digit && startsBlock() && block_.number < 0) {
      ++at_;
      setNumber(begin, takeWhole());
      if (at_ < end_ && (*at_ == '.' || *at_ == ',')) {
        while (at_ < end_ && (isNumberDigit(*at_) || *at_ == '.' || *at_ == ','))
          ++at_;
        issue(SyntaxIssueKind::MalformedNumber, begin, at_);
      }
      return;
    }
    break;
  case 'R':
  case 'V': {
    const char *p = next;
    while (p < end_ && isNumberDigit(*p))
      ++p;
    const char *const sign = behindBlanks(p);
    if (p > next && sign < end_ && *sign == '=')
      return scanAssignment(begin);
    break;
  }
  case 'L': {
    const char *const open = behindBlanks(next);
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
      if (const char *const axes = behindBlanks(next + 2); axes < end_ && isLetter(*axes))
        return scanPlane(begin);
    break;
  default:
    break;
  }
  ++at_;
  scanValue(address, begin);
}

/// `G16XYZ+`: a free plane, its axis and direction.
void Scanner::scanPlane(const char *begin) {
  at_ = behindBlanks(begin + 3);
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
  keyword(code, begin, at_);
}

/// The number, `= expression` or `<expression>` behind an address.
void Scanner::scanValue(AddressId address, const char *begin) {
  Word word;
  word.address = address;
  if (at_ < end_ && (isNumberDigit(*at_) || *at_ == '-')) {
    if (const char *const behind = readPlainNumber(at_, end_, word)) {
      at_ = behind;
      // `G54.01`: two digits behind the point are a number of their own.
      if (address == letterAddress('G') && word.decimals == 2)
        if (const CodeIndex code = dialect_.keyword({begin, size_t(at_ - begin)}); code != noCode)
          return keyword(code, begin, at_);
      // `D0`: no segment, and no number of a correction.
      if (address == letterAddress('D') && word.mantissa == 0)
        if (const CodeIndex code = dialect_.keyword({begin, size_t(at_ - begin)}); code != noCode)
          return keyword(code, begin, at_);
      return addWord(word, begin);
    }
  }
  const char *const value = behindBlanks(at_);
  const char c = value < end_ ? *value : '\n';
  if (c == '=' || c == '<') {
    // Behind K, and where axes are only named, a bracket is an item of its own.
    const bool bare = c == '<' && (value > at_ || address == letterAddress('K'));
    if (!bare) {
      at_ = value;
      uint16_t index = 0;
      if (c == '<') {
        index = bracketed();
      } else {
        ++at_;
        skipBlanks();
        if (atLineEnd() || *at_ == '<') {
          word.flags = wordNoValue;
          issue(SyntaxIssueKind::MissingValue, begin, at_);
          return addWord(word, begin);
        }
        index = expression();
        if (address == letterAddress('G') || address == letterAddress('M') ||
            address == letterAddress('T') || address == letterAddress('N'))
          issue(SyntaxIssueKind::RealForInteger, begin, at_);
      }
      word.flags = wordExpression;
      word.mantissa = index;
      extendExpression(word);
      return addWord(word, begin);
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

bool Scanner::scanNumber(Word &word, const char *begin) {
  const bool negative = takeSign(word, begin);
  if (!takeDigits(word, begin, negative, /*leadingComma=*/true))
    return false;
  takeExcess(word, begin);
  return true;
}

/// `R1 = R2 + 10`, `#271=5`
void Scanner::scanAssignment(const char *begin) {
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

/// `L1`, `P2`, `O5`: an element of a contour by its name; `=` defines it.
void Scanner::scanElement(const char *begin) {
  const char letter = char(*begin & ~32);
  Word word;
  word.address = letterAddress(letter);
  ++at_;
  word.mantissa = takeWhole(1'000'000'000);
  addWord(word, begin);
  const char *const sign = behindBlanks(at_);
  if (sign == end_ || *sign != '=')
    return;
  // What defines it moves nothing: its words are its own.
  at_ = lineEnd();
  if (const CodeIndex code = dialect_.keyword("ELEMENT"); code != noCode)
    keyword(code, begin, at_);
}

/// `L<NAME>`, `L<&R12>`, `L<C:\PATH\NAME>`
void Scanner::scanCall(const char *begin) {
  ++at_; // the bracket
  skipBlanks();
  Item item = itemAt(ItemKind::Call, begin);
  if (at_ < end_ && *at_ == '&') {
    ++at_;
    item.value = expression();
    closeAngle(begin);
    return add(item);
  }
  const char *const from = at_;
  skipToAngle();
  const llvm::StringRef called = withoutFolder({from, size_t(at_ - from)});
  closeAngle(begin);
  if (called.empty())
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  if (const CodeIndex code = dialect_.keyword(("L<" + called).str()); code != noCode)
    return keyword(code, begin, at_);
  nameItem(item, called);
  add(item);
}

/// The bracket that closes what was opened at `begin`.
void Scanner::closeAngle(const char *begin) {
  skipBlanks();
  if (at_ < end_ && *at_ == '>') {
    ++at_;
    return;
  }
  const char *p = at_;
  while (p < end_ && !isLineEnd(*p) && *p != '>' && *p != '<')
    ++p;
  if (p < end_ && *p == '>') {
    issue(SyntaxIssueKind::BadExpression, at_, p);
    at_ = p + 1;
    return;
  }
  issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
}

void Scanner::scanAngle() {
  const char *const begin = at_++;
  skipBlanks();
  const llvm::StringRef word = name();
  if (word.empty() || word == "%" || word == "%%") {
    skipToAngle();
    closeAngle(begin);
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  }
  const char *const behind = behindBlanks(word.end());
  const char c = behind < end_ ? *behind : '\n';
  if (c == '=') {
    at_ = behind + 1;
    return scanVariable(begin, word);
  }
  if (c == '<' && (word.equals_insensitive("IFF") || word.equals_insensitive("IFC"))) {
    at_ = behind;
    return scanChoice(begin, word.equals_insensitive("IFC"));
  }
  if (c == ':') {
    at_ = behind + 1;
    return scanInstruction(begin, word);
  }
  at_ = behind;
  const CodeIndex code = dialect_.keyword(word);
  closeAngle(begin);
  if (code != noCode)
    return keyword(code, begin, at_);
  issue(c == '>' ? SyntaxIssueKind::MissingValue : SyntaxIssueKind::BadStatement, begin, at_);
}

/// `<ENT=-10>`, `<CFF=CFZ>`
void Scanner::scanVariable(const char *begin, llvm::StringRef variable) {
  Item item = itemAt(ItemKind::Assignment, begin);
  nameItem(item, variable);
  item.target = constant(variable.begin(), variable.end(), double(variableKey(variable)));
  skipBlanks();
  Word word;
  word.address = variableAddress;
  const llvm::StringRef symbol = name();
  const char *const behind = behindBlanks(symbol.end());
  if (atLineEnd() || *at_ == '>') {
    word.flags = wordNoValue;
    issue(SyntaxIssueKind::MissingValue, begin, at_);
  } else if (symbol.size() == 3 && symbol.startswith_insensitive("CF") && behind < end_ &&
             *behind == '>') {
    // The name of an axis stands for itself; as a number it is its key.
    item.value = constant(symbol.begin(), symbol.end(), double(variableKey(symbol)));
    word.flags = wordExpression;
    word.mantissa = item.value;
    at_ = symbol.end();
  } else {
    const char *const from = at_;
    const char *number = nullptr;
    if (isNumberDigit(*at_) || *at_ == '-')
      number = readPlainNumber(at_, end_, word);
    const char *const next = number ? behindBlanks(number) : nullptr;
    if (next && next < end_ && *next == '>') {
      at_ = number;
      item.value = constant(from, number, word.value());
    } else {
      word = Word();
      word.address = variableAddress;
      item.value = expression();
      word.flags = wordExpression;
      word.mantissa = item.value;
    }
  }
  closeAngle(begin);
  add(item);
  extendExpression(word);
  addWord(word, begin);
}

/// `;` or `,`; 0: neither is at hand.
char Scanner::scanSeparator() {
  skipBlanks();
  if (at_ < end_ && (*at_ == ';' || *at_ == ','))
    return *at_++;
  return 0;
}

void Scanner::scanString(Argument &argument) {
  bool comment = false;
  unsigned mark = *at_ == '"' ? 1 : typographicQuote(at_, end_, comment);
  if (mark > 1)
    issue(SyntaxIssueKind::TypographicQuote, at_, at_ + mark);
  const char *const begin = at_;
  at_ += mark;
  argument.kind = ArgumentKind::Text;
  argument.begin = offset(at_);
  for (mark = 0; !atLineEnd(); ++at_) {
    mark = *at_ == '"' ? 1 : typographicQuote(at_, end_, comment);
    if (mark)
      break;
  }
  argument.end = offset(at_);
  if (!mark)
    return issue(SyntaxIssueKind::UnclosedString, begin, at_);
  at_ += mark;
}

/// `N50`, `N<R1>`, `[LABEL]`
Argument Scanner::scanTarget(char separator) {
  skipBlanks();
  Argument target;
  target.separator = separator;
  target.begin = target.end = offset(at_);
  if (endsArgument(at_))
    return target;
  if (*at_ == '[') {
    const char *const begin = ++at_;
    while (!atLineEnd() && *at_ != ']' && *at_ != '>')
      ++at_;
    target.kind = ArgumentKind::Label;
    target.begin = offset(begin);
    target.end = offset(at_);
    if (at_ < end_ && *at_ == ']')
      ++at_;
    else
      issue(SyntaxIssueKind::UnbalancedBracket, begin - 1, at_);
    return target;
  }
  if ((*at_ | 32) == 'n') {
    const char *const begin = at_++;
    target.kind = ArgumentKind::BlockNumber;
    if (at_ < end_ && *at_ == '<') {
      target.expression = bracketed();
    } else {
      const char *const digits = at_;
      const auto number = double(takeWhole());
      target.expression = constant(begin, at_, number);
      if (at_ == digits) {
        block_.operations.back().op = Op::Opaque;
        issue(SyntaxIssueKind::BadStatement, begin, at_);
      }
    }
    target.end = offset(at_);
    return target;
  }
  return scanArgument(separator);
}

/// `named`: the name of the argument has been read.
Argument Scanner::scanArgument(char separator, bool named) {
  skipBlanks();
  Argument argument;
  argument.separator = separator;
  argument.begin = argument.end = offset(at_);
  bool comment = false;
  if (endsArgument(at_))
    return argument;
  if (*at_ == '"' || typographicQuote(at_, end_, comment)) {
    scanString(argument);
    return argument;
  }
  if (*at_ == '<') {
    argument.kind = ArgumentKind::Expression;
    argument.expression = bracketed();
    argument.end = offset(at_);
    return argument;
  }
  const llvm::StringRef symbol = name();
  const char *const behind = behindBlanks(symbol.end());
  const bool ends = endsArgument(behind);
  // A symbol: ON, an axis, a name. `R12` is a variable.
  const bool variable = symbol.size() > 1 && (symbol[0] | 32) == 'r' &&
                        llvm::all_of(symbol.drop_front(), isNumberDigit);
  if (!symbol.empty() && isLetter(symbol[0]) && ends && !variable) {
    argument.kind = ArgumentKind::Name;
    at_ = symbol.end();
    argument.end = offset(at_);
    return argument;
  }
  // `ON/X`: the switch is a symbol, what stands behind it is no separator.
  if ((symbol.equals_insensitive("ON") || symbol.equals_insensitive("OFF")) && !ends) {
    argument.kind = ArgumentKind::Name;
    at_ = symbol.end();
    argument.end = offset(at_);
    return argument;
  }
  if (!named && !symbol.empty() && isLetter(symbol[0]) && behind < end_ && *behind == '=') {
    argument.nameBegin = argument.begin; // `AX=X`
    argument.nameEnd = offset(symbol.end());
    at_ = behind + 1;
    skipBlanks();
    Argument value = scanArgument(separator, true);
    value.nameBegin = argument.nameBegin;
    value.nameEnd = argument.nameEnd;
    return value;
  }
  const char *const before = at_;
  argument.kind = ArgumentKind::Expression;
  argument.expression = expression();
  argument.end = offset(at_);
  if (at_ == before && !atLineEnd() && *at_ != '>')
    ++at_;
  return argument;
}

/// A name up to the separator.
llvm::StringRef Scanner::scanProgramName() {
  skipBlanks();
  const char *const begin = at_;
  while (!endsArgument(at_))
    ++at_;
  return withoutFolder({begin, size_t(at_ - begin)});
}

/// An argument of an instruction as a word, so that the table can say what it takes. A name stands
/// for itself; as a number it is its key.
void Scanner::argumentWord(const Argument &argument) {
  Word word;
  word.address = argumentAddress;
  if (argument.kind == ArgumentKind::Empty) {
    word.flags = wordNoValue;
  } else {
    word.flags = wordExpression;
    const char *const begin = base_ + argument.begin, *const end = base_ + argument.end;
    word.mantissa = argument.expression != noExpression ? argument.expression
                    : argument.kind == ArgumentKind::Name
                        ? constant(begin, end, double(variableKey({begin, size_t(end - begin)})))
                        : opaque(begin, end);
  }
  const char *const at = at_;
  at_ = base_ + argument.end;
  addWord(word, base_ + argument.begin);
  at_ = at;
}

void Scanner::scanInstruction(const char *begin, llvm::StringRef word) {
  const std::string key = word.upper();
  if (key == "JMP" || key == "JMC")
    return scanJump(begin, key == "JMC");
  if (key == "RPT")
    return scanRepeat(begin);
  if (key == "INP")
    return scanInput(begin);
  Item item = itemAt(ItemKind::Instruction, begin);
  nameItem(item, word);
  std::string first;
  for (char separator = 0;;) {
    const Argument argument = scanArgument(separator);
    if (argument.kind == ArgumentKind::Empty && !separator && at_ < end_ && *at_ == '>')
      break;
    if (first.empty() && argument.kind == ArgumentKind::Name && !separator)
      first = llvm::StringRef(base_ + argument.begin, argument.end - argument.begin).upper();
    block_.arguments.push_back(argument);
    separator = scanSeparator();
    if (!separator)
      break;
  }
  closeAngle(begin);
  add(item);
  CodeIndex code = dialect_.keyword(key + ":" + first);
  if (code == noCode)
    code = dialect_.keyword(key);
  if (code == noCode)
    return issue(SyntaxIssueKind::UnknownWord, word.begin(), word.end());
  keyword(code, begin, at_);
  const llvm::SmallVector<Argument, 8> arguments(block_.argumentsOf(item).begin(),
                                                 block_.argumentsOf(item).end());
  for (const Argument &argument : inOrder(arguments, dialect_.codes[code]))
    argumentWord(argument);
}

/// Arguments with names (`AX=XY`, `P5`) at the places that the table gives these names; the others
/// as written.
llvm::SmallVector<Argument, 8> Scanner::inOrder(llvm::ArrayRef<Argument> written,
                                                const CodeInfo &code) {
  llvm::SmallVector<Argument, 8> placed;
  for (Argument argument : written) {
    size_t place = placed.size();
    llvm::StringRef name(base_ + argument.nameBegin, argument.nameEnd - argument.nameBegin);
    const llvm::StringRef text(base_ + argument.begin, argument.end - argument.begin);
    double number = 0;
    const bool numbered = argument.kind == ArgumentKind::Name && name.empty() && text.size() > 1 &&
                          !text.drop_front().getAsDouble(number);
    if (numbered)
      name = text.take_front();
    if (!name.empty())
      for (const WordSpec &spec : code.words)
        if (spec.position && name.equals_insensitive(spec.name)) {
          place = spec.position - 1;
          if (numbered)
            argument.expression = constant(text.begin(), text.end(), number);
        }
    if (place >= placed.size()) {
      Argument empty;
      empty.begin = empty.end = argument.begin;
      placed.resize(place + 1, empty);
    }
    placed[place] = argument;
  }
  return placed;
}

/// The program in which a jump's target lies.
void Scanner::scanOtherProgram(Item &item, const char *begin) {
  nameItem(item, scanProgramName());
  if (!scanSeparator())
    issue(SyntaxIssueKind::MissingArgument, begin, at_);
}

/// What stands behind the last argument is passed over.
void Scanner::tooManyArguments(const char *begin) {
  issue(SyntaxIssueKind::TooManyArguments, begin, at_);
  skipToAngle();
}

/// `<JMP:N50>`, `<JMP:[A]>`, `<JMC: PROG; N50>`
void Scanner::scanJump(const char *begin, bool other) {
  Item item = itemAt(ItemKind::Jump, begin);
  if (other)
    scanOtherProgram(item, begin);
  block_.arguments.push_back(scanTarget(0));
  if (scanSeparator())
    tooManyArguments(begin);
  closeAngle(begin);
  add(item);
}

/// Behind the expression of a choice something else than `:` stands, mostly a comparison
/// (`<IFF<R1 > 5>:`): one report, and reading goes on at the targets.
void Scanner::missingColon(const char *begin) {
  const llvm::StringRef rest(at_, size_t(end_ - at_));
  const size_t colon = rest.find_first_of(":;\r\n");
  if (colon == llvm::StringRef::npos || rest[colon] != ':')
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  at_ += colon;
  const char *const expression = std::find(begin + 1, at_, '<');
  issue(SyntaxIssueKind::BadExpression, expression, at_);
  ++at_;
}

/// `<IFF<R1-5>: N10; N20; N30>`, `<IFC<R1>: PROG; N10; N20; N30>`
void Scanner::scanChoice(const char *begin, bool other) {
  Item item = itemAt(ItemKind::Jump, begin);
  item.jump = JumpKind::BySign;
  item.condition = bracketed();
  skipBlanks();
  if (at_ < end_ && *at_ == ':')
    ++at_;
  else
    missingColon(begin);
  if (other)
    scanOtherProgram(item, begin);
  unsigned targets = 0;
  for (char separator = 0;; ++targets) {
    const Argument target = scanTarget(separator);
    if (target.kind == ArgumentKind::Empty)
      break;
    if (targets < 3)
      block_.arguments.push_back(target);
    separator = scanSeparator();
    if (!separator) {
      ++targets;
      break;
    }
  }
  closeAngle(begin);
  if (targets != 3)
    issue(targets < 3 ? SyntaxIssueKind::MissingArgument : SyntaxIssueKind::TooManyArguments, begin,
          at_);
  add(item);
}

/// `<RPT:N10;N20;3>`
void Scanner::scanRepeat(const char *begin) {
  Item item = itemAt(ItemKind::Repeat, begin);
  block_.arguments.push_back(scanTarget(0));
  const char separator = scanSeparator();
  if (separator) {
    block_.arguments.push_back(scanTarget(separator));
    if (scanSeparator()) {
      const Argument count = scanArgument(separator);
      if (count.expression != noExpression)
        item.count = count.expression;
      if (scanSeparator())
        tooManyArguments(begin);
    }
  } else {
    issue(SyntaxIssueKind::MissingArgument, begin, at_);
  }
  closeAngle(begin);
  add(item);
}

/// `<INP: "prompt"; R0; N100; 10; 100>`: the target for ESC is the first argument of the item,
/// behind it the prompt and the bounds.
void Scanner::scanInput(const char *begin) {
  Item item = itemAt(ItemKind::Input, begin);
  const Argument prompt = scanArgument(0);
  bool complete = prompt.kind == ArgumentKind::Text;
  if (scanSeparator()) {
    skipBlanks();
    item.nameBegin = offset(at_);
    item.target = parsed(&EcsExpression::parseTarget);
    item.nameEnd = offset(at_);
  } else {
    complete = false;
  }
  if (const char separator = scanSeparator())
    block_.arguments.push_back(scanTarget(separator));
  else
    complete = false;
  block_.arguments.push_back(prompt);
  for (unsigned bounds = 0; const char separator = scanSeparator(); ++bounds) {
    if (bounds == 2) {
      tooManyArguments(begin);
      break;
    }
    block_.arguments.push_back(scanArgument(separator));
  }
  closeAngle(begin);
  if (!complete)
    issue(SyntaxIssueKind::MissingArgument, begin, at_);
  add(item);
}

void Scanner::scanOther() {
  const char *const begin = at_;
  if (isNumberDigit(*at_) || *at_ == '.' || *at_ == '-' || *at_ == '+') {
    skipNumberCharacters();
    return issue(SyntaxIssueKind::MissingAddress, begin, at_);
  }
  switch (*at_) {
  case '>':
  case ']':
  case '}':
    ++at_;
    return issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
  case ')':
    ++at_;
    return issue(SyntaxIssueKind::StrayParenthesis, begin, at_);
  case ';':
    // A comment of another control.
    at_ = lineEnd();
    return issue(SyntaxIssueKind::ForeignComment, begin, at_);
  default:
    break;
  }
  ++at_;
  while (at_ < end_ && (uint8_t(*at_) >= 128 || *at_ == *begin))
    ++at_;
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

} // namespace

EcsReader::EcsReader(const Dialect &dialect, llvm::StringRef text)
    : Reader(text), dialect_(dialect) {
  for (size_t i = 0; i < dialect.addressNames.size(); ++i)
    addresses_[llvm::StringRef(dialect.addressNames[i]).upper()] = AddressId(firstNamed + i);
}

void EcsReader::read(uint32_t offset, Block &block) const {
  block.clear();
  Scanner(dialect_, addresses_, text_, offset, block).scan();
}

std::string EcsReader::labelKey(llvm::StringRef label) const {
  constexpr size_t significant = 8;
  std::string key;
  for (const char c : label.split(':').first)
    if (!isLineBlank(c) && key.size() < significant)
      key += llvm::toUpper(c);
  return key;
}

} // namespace ncvet
