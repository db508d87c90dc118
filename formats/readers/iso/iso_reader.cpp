// Reader of word-address programs (ISO 6983, DIN 66025): FANUC, Haas, NCT and their kin.
#include "formats/readers/iso/iso_reader.h"

#include "formats/readers/block_scanner.h"
#include "formats/readers/iso/macro_expression.h"
#include "formats/readers/plain_number.h"

#include "llvm/ADT/SmallString.h"
#include "llvm/ADT/StringExtras.h"
#include "llvm/ADT/StringSwitch.h"
#include "llvm/Support/xxhash.h"

#include <array>
#include <cstring>

namespace ncvet {

namespace {

enum CharClass : uint8_t { Other, Letter, LowerLetter, Digit, Blank, LineEnd };

constexpr std::array<CharClass, 256> makeClasses() {
  std::array<CharClass, 256> classes{};
  for (unsigned c = 'A'; c <= 'Z'; ++c)
    classes[c] = Letter;
  for (unsigned c = 'a'; c <= 'z'; ++c)
    classes[c] = LowerLetter;
  for (unsigned c = '0'; c <= '9'; ++c)
    classes[c] = Digit;
  classes[' '] = classes['\t'] = classes['\v'] = classes['\f'] = classes[0] = Blank;
  classes['\n'] = classes['\r'] = LineEnd;
  return classes;
}
constexpr std::array<CharClass, 256> classes = makeClasses();

CharClass classOf(char c) { return classes[uint8_t(c)]; }
bool isDigit(char c) { return isNumberDigit(c); }

/// A label of an O-word in the one form of all its spellings.
std::string flowLabel(llvm::StringRef label) {
  std::string key;
  for (const char c : label)
    if (c != ' ' && c != '\t')
      key += llvm::toUpper(c);
  return key;
}

class Scanner : BlockScanner<> {
public:
  Scanner(const Lexical &lexical, const IsoReader::Symbols &symbols, llvm::StringRef text,
          uint32_t offset, Block &block)
      : BlockScanner(text, offset, block), lexical_(lexical), symbols_(symbols) {}

  void scan();

private:
  void scanTape();
  void scanHeader(const char *begin);
  void scanComment();
  void scanAbort(const char *begin);
  void scanLetter();
  bool scanUnknownWord();
  void scanWord(AddressId address, const char *begin);
  bool opensExpression(const char *p) const;
  bool scanPlainNumber(Word &word);
  bool scanNumber(Word &word, const char *begin);
  void scanComma();
  void scanOther();
  bool scanStatement();
  void scanAssignment();
  void scanFlowWord();
  void scanCallArguments(Item &item);
  uint16_t bracketIfAny();
  void passBlanksInNumber();
  uint16_t expression(MacroExpression::Form form) {
    return parsed(&MacroExpression::parse, form, lexical_.arithmetic);
  }
  const Lexical &lexical_;
  const IsoReader::Symbols &symbols_;
};

void Scanner::scan() {
  block_.begin = offset(at_);
  skipBlanks();
  if (at_ < end_ && *at_ == '%') {
    scanTape();
  } else {
    while (at_ < end_) {
      const char c = *at_;
      switch (classOf(c)) {
      case Blank:
        ++at_;
        continue;
      case Letter:
        scanLetter();
        continue;
      case LowerLetter:
        block_.lowerCase = true;
        scanLetter();
        continue;
      case LineEnd:
        break;
      case Digit:
      case Other:
        scanOther();
        continue;
      }
      break;
    }
  }
  block_.end = offset(at_);
  takeLineEnd();
  if (block_.kind == BlockKind::Normal && block_.isEmpty() && block_.issues.empty() &&
      block_.number < 0 && block_.skip < 0)
    block_.kind = BlockKind::Empty;
}

void Scanner::scanTape() {
  const char *begin = at_++;
  block_.kind = BlockKind::Tape;
  const char *after = at_;
  while (after < end_ && classOf(*after) == Blank)
    ++after;
  if (lexical_.percentHeader && after < end_ &&
      (*after == 'O' || *after == 'o' || *after == ':' || isDigit(*after))) {
    at_ = after;
    scanHeader(begin);
    while (!atLineEnd()) {
      if (*at_ == '(')
        scanComment();
      else
        ++at_;
    }
    return;
  }
  at_ = lineEnd();
}

/// `O` or `:` and digits; everything up to a blank or a comment belongs to the name.
void Scanner::scanHeader(const char *begin) {
  block_.kind = BlockKind::ProgramHeader;
  block_.headerBegin = offset(begin);
  if (!isDigit(*at_))
    ++at_;
  while (at_ < end_ && classOf(*at_) == Blank)
    ++at_;
  int64_t number = 0;
  unsigned digits = 0;
  while (at_ < end_ && isDigit(*at_)) {
    if (digits++ < 9)
      number = number * 10 + (*at_ - '0');
    ++at_;
  }
  block_.program = digits && digits <= 9 ? number : -1;
  if (lexical_.percentHeader)
    while (!atLineEnd() && classOf(*at_) != Blank && *at_ != '(')
      ++at_;
  block_.headerEnd = offset(at_);
}

void Scanner::scanComment() {
  const char *begin = at_;
  const char *line = lineEnd();
  const auto *close = static_cast<const char *>(memchr(at_, ')', size_t(line - at_)));
  const auto *inner = static_cast<const char *>(memchr(at_ + 1, '(', size_t(line - at_ - 1)));
  if (!close) {
    issue(SyntaxIssueKind::UnclosedComment, begin, line);
    at_ = line;
  } else if (inner && inner < close) {
    // The comment ends at the first `)` for the control; when the parentheses balance the writer
    // meant the outer one, and that is where reading goes on.
    unsigned depth = 0;
    const char *p = begin;
    const char *outer = nullptr;
    for (; p < line; ++p) {
      if (*p == '(')
        ++depth;
      else if (*p == ')' && --depth == 0) {
        outer = p;
        break;
      }
    }
    issue(SyntaxIssueKind::NestedComment, inner, close + 1);
    at_ = (outer ? outer : close) + 1;
  } else {
    at_ = close + 1;
  }
  block_.comments.push_back({offset(begin), offset(at_)});
  if (!lexical_.abortMark.empty())
    scanAbort(begin);
}

/// A comment that stops the program.
void Scanner::scanAbort(const char *begin) {
  const llvm::StringRef text = llvm::StringRef(begin + 1, size_t(at_ - begin - 1)).ltrim();
  if (!text.startswith_insensitive(lexical_.abortMark))
    return;
  Item item;
  item.kind = ItemKind::Abort;
  item.wordsBefore = uint16_t(block_.words.size());
  item.begin = offset(begin);
  item.end = offset(at_);
  block_.items.push_back(item);
}

void Scanner::scanLetter() {
  const char *begin = at_;
  const char upper = char(*at_ & ~32);
  if (upper == 'O' && lexical_.flowWords)
    return scanFlowWord();
  if (at_ + 1 < end_ && isLetter(at_[1])) {
    if (lexical_.macro && !lexical_.flowWords && scanStatement())
      return;
    if (scanUnknownWord())
      return;
  }
  if (upper == 'O' && block_.words.empty() && block_.items.empty()) {
    const char *p = at_ + 1;
    while (p < end_ && classOf(*p) == Blank)
      ++p;
    if (p < end_ && isDigit(*p)) {
      scanHeader(begin);
      return;
    }
  }
  ++at_;
  scanWord(letterAddress(upper), begin);
}

/// Three letters and more in a row are no addresses: one issue for all of it. Bare axis letters,
/// which a reference return may name together, are left alone.
bool Scanner::scanUnknownWord() {
  const char *begin = at_;
  const char *p = at_;
  bool axes = true;
  while (p < end_ && isLetter(*p))
    axes &= llvm::StringRef("XYZABCUVW").contains(char(*p++ & ~32));
  if (p - begin < 3 || axes)
    return false;
  while (p < end_ && (isLetter(*p) || isDigit(*p) || *p == '_'))
    ++p;
  at_ = p;
  issue(SyntaxIssueKind::UnknownWord, begin, p);
  return true;
}

/// A variable, a bracket, or a function where it may be without brackets around it: `XSIN[30]`.
bool Scanner::opensExpression(const char *p) const {
  if (p < end_ && (*p == '#' || *p == '['))
    return true;
  if (lexical_.arithmetic != Arithmetic::Ngc)
    return false;
  const char *name = p;
  while (p < end_ && uint8_t((*p | 32) - 'a') < 26)
    ++p;
  return p - name > 1 && behindBlanks(p) < end_ && *behindBlanks(p) == '[';
}

/// The number or expression after an address.
void Scanner::scanWord(AddressId address, const char *begin) {
  Word word;
  word.address = address;
  word.offset = offset(begin);
  const char *p = at_;
  // By far the most words: a number is right after a letter that opens no header or number.
  if (p < end_ && (isDigit(*p) || *p == '-') && address != letterAddress('N') &&
      scanPlainNumber(word)) {
    word.length = uint8_t(std::min<ptrdiff_t>(at_ - begin, 255));
    append(word);
    return;
  }
  while (p < end_ && classOf(*p) == Blank)
    ++p;
  if (lexical_.incrementOperator && p < end_ && (*p | 32) == 'i' && p + 1 < end_ &&
      (isDigit(p[1]) || p[1] == '-' || p[1] == '+' || p[1] == '.')) {
    word.flags |= wordIncremental;
    ++p;
  }
  const char *number = p;
  at_ = number;
  if (at_ < end_ &&
      (isDigit(*at_) || *at_ == '-' || *at_ == '+' || *at_ == '.' || typographicMinus(at_, end_))) {
    // A sign before an expression belongs to it.
    const bool ngc = lexical_.arithmetic == Arithmetic::Ngc;
    const char *behind = at_;
    unsigned signs = 0;
    while (behind < end_ && (classOf(*behind) == Blank ||
                             ((*behind == '-' || *behind == '+') && (ngc || signs == 0))))
      signs += classOf(*behind++) != Blank;
    if (!(lexical_.macro && (opensExpression(behind) || signs > 1))) {
      if (!scanNumber(word, begin)) {
        word.flags |= wordMalformed | wordNoValue;
      }
      word.length = uint8_t(std::min<ptrdiff_t>(at_ - begin, 255));
      if (address == letterAddress('N') && block_.number < 0 && word.isNumber()) {
        const bool first = block_.words.empty() && block_.items.empty();
        if (first) {
          block_.number = word.mantissa;
          block_.numberBegin = word.offset;
          block_.numberEnd = offset(at_);
          if (word.has(wordPoint) && !lexical_.freeNumbers)
            issue(SyntaxIssueKind::MalformedNumber, begin, at_);
          return;
        }
      }
      if (address == letterAddress('N') && lexical_.flowWords) // (LinuxCNC 2.9, section 11.4.2.2)
        issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
      append(word);
      return;
    }
  }
  if (lexical_.macro && at_ < end_ && (opensExpression(at_) || *at_ == '-' || *at_ == '+')) {
    const uint16_t index = expression(MacroExpression::Form::Operand);
    word.flags |= wordExpression;
    word.mantissa = index;
    append(word);
    return;
  }
  // Nothing readable after the address.
  at_ = begin + (*begin == ',' ? 2 : 1);
  word.flags |= wordNoValue;
  word.length = uint8_t(at_ - begin);
  issue(SyntaxIssueKind::MissingValue, begin, at_);
  append(word);
}

/// The usual number; false, with nothing read, for every other one.
bool Scanner::scanPlainNumber(Word &word) {
  const Word before = word;
  const char *const behind = readPlainNumber(at_, end_, word);
  if (!behind)
    return false;
  if (lexical_.freeNumbers && behind < end_ && classOf(*behind) == Blank) {
    const char *const p = behindBlanks(behind);
    if (p < end_ && (isDigit(*p) || *p == '.')) { // it goes on after the blanks
      word = before;
      return false;
    }
  }
  at_ = behind;
  return true;
}

/// Where blanks may be inside numbers: steps over those before a further digit or point.
void Scanner::passBlanksInNumber() {
  if (!lexical_.freeNumbers || at_ >= end_ || classOf(*at_) != Blank)
    return;
  const char *const p = behindBlanks(at_);
  if (p < end_ && (isDigit(*p) || *p == '.'))
    at_ = p;
}

/// Reads `[sign] digits [. digits]`; false when there is no digit at all.
bool Scanner::scanNumber(Word &word, const char *begin) {
  if (scanPlainNumber(word))
    return true;
  bool negative = false;
  if (const unsigned bytes = typographicMinus(at_, end_)) {
    issue(SyntaxIssueKind::TypographicMinus, at_, at_ + bytes);
    negative = true;
    word.flags |= wordMinus;
    at_ += bytes;
  } else if (*at_ == '-') {
    negative = true;
    word.flags |= wordMinus;
    ++at_;
  } else if (*at_ == '+') {
    word.flags |= wordPlus;
    ++at_;
  }
  if (at_ < end_ && classOf(*at_) == Blank && (word.flags & (wordMinus | wordPlus))) {
    const char *p = at_;
    while (p < end_ && classOf(*p) == Blank)
      ++p;
    if (p < end_ && (isDigit(*p) || *p == '.')) {
      if (!lexical_.freeNumbers)
        issue(SyntaxIssueKind::BlankInNumber, begin, p + 1);
      at_ = p;
    }
  }
  uint64_t mantissa = 0;
  unsigned digits = 0;
  const char *first = at_;
  unsigned whole = 0;
  while (at_ < end_ && isDigit(*at_)) {
    if (digits < maxNumberDigits)
      mantissa = mantissa * 10 + unsigned(*at_ - '0');
    else
      word.flags |= wordMalformed;
    if (mantissa)
      ++digits;
    ++whole;
    ++at_;
    passBlanksInNumber();
  }
  if (whole > 1 && *first == '0')
    word.flags |= wordLeadingZero;
  unsigned decimals = 0;
  unsigned fraction = 0;
  if (at_ < end_ && (*at_ == '.' || (*at_ == ',' && whole && at_ + 1 < end_ && isDigit(at_[1])))) {
    if (*at_ == ',') {
      // A decimal comma: read as it was meant.
      const char *p = at_ + 1;
      while (p < end_ && isDigit(*p))
        ++p;
      issue(SyntaxIssueKind::DecimalComma, begin, p);
    }
    word.flags |= wordPoint;
    ++at_;
    passBlanksInNumber();
    while (at_ < end_ && isDigit(*at_)) {
      if (digits < maxNumberDigits && decimals < maxNumberDigits) {
        mantissa = mantissa * 10 + unsigned(*at_ - '0');
        ++decimals;
        if (mantissa)
          ++digits;
      }
      ++fraction;
      ++at_;
      passBlanksInNumber();
    }
  }
  const bool any = whole || fraction;
  if (at_ < end_ && (*at_ == '.' || (any && (*at_ == '-' || *at_ == '+') && at_ + 1 < end_ &&
                                     (isDigit(at_[1]) || at_[1] == '.')))) {
    // A second point, or a sign after the number: one report up to the next address.
    while (at_ < end_ && (*at_ == '.' || isDigit(*at_) || *at_ == '-' || *at_ == '+'))
      ++at_;
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
    word.flags |= wordMalformed;
  } else if (!any) {
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  }
  if (!any)
    return false;
  word.mantissa = negative ? -int64_t(mantissa) : int64_t(mantissa);
  word.decimals = uint8_t(decimals);
  return true;
}

/// `,R2` and its like; elsewhere a comma is no character of the language.
void Scanner::scanComma() {
  const char *begin = at_;
  if (at_ + 1 < end_) {
    const char letter = char(at_[1] & ~32);
    const AddressId address = letter == 'A'   ? commaA
                              : letter == 'C' ? commaC
                              : letter == 'R' ? commaR
                                              : noAddress;
    if (address != noAddress) {
      at_ += 2;
      scanWord(address, begin);
      return;
    }
  }
  ++at_;
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

void Scanner::scanOther() {
  const char *begin = at_;
  if (uint8_t(*at_) < symbols_.size() && symbols_[uint8_t(*at_)] != noAddress) {
    ++at_;
    return scanWord(symbols_[uint8_t(*begin)], begin);
  }
  switch (*at_) {
  case '(':
    scanComment();
    return;
  case ')':
    ++at_;
    issue(SyntaxIssueKind::StrayParenthesis, begin, at_);
    return;
  case ';': {
    const char *line = lineEnd();
    const char *p = at_ + 1;
    while (p < line && classOf(*p) == Blank)
      ++p;
    if (p < line)
      block_.comments.push_back({offset(begin), offset(line)});
    at_ = line;
    return;
  }
  case '/': {
    if (lexical_.flowWords && !(block_.words.empty() && block_.items.empty()))
      break; // only before everything else
    ++at_;
    int8_t level = 0;
    if (at_ < end_ && *at_ >= '1' && *at_ <= '9') {
      level = int8_t(*at_ - '0');
      ++at_;
    }
    if (block_.skip < 0)
      block_.skip = level;
    return;
  }
  case ',':
    scanComma();
    return;
  case '#':
    if (lexical_.macro) {
      scanAssignment();
      return;
    }
    break;
  case ':':
    if (block_.words.empty() && block_.items.empty() && at_ + 1 < end_ && isDigit(at_[1])) {
      scanHeader(begin);
      return;
    }
    break;
  case '%':
    // `M30%` on one line: the tape mark ends the program here too.
    block_.tapeInside = true;
    at_ = lineEnd();
    return;
  case '\x1A': {
    // End-of-file mark of older systems, often with padding after it.
    const char *p = at_;
    while (p < end_ && (*p == '\x1A' || classOf(*p) == Blank || classOf(*p) == LineEnd))
      ++p;
    if (p == end_) {
      at_ = end_;
      return;
    }
    break;
  }
  case '[':
  case ']':
    ++at_;
    issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
    return;
  default:
    break;
  }
  const bool numberFollows =
      isDigit(*at_) || *at_ == '.' || *at_ == '-' || *at_ == '+' || typographicMinus(at_, end_);
  if (numberFollows) {
    // A number without an address: one issue for the whole of it, unless it is no number either.
    Word ignored;
    const size_t before = block_.issues.size();
    const bool any = scanNumber(ignored, begin);
    if (any && block_.issues.size() == before)
      issue(SyntaxIssueKind::MissingAddress, begin, at_);
    if (at_ == begin)
      ++at_;
    return;
  }
  if (uint8_t(*at_) < 128 && *at_ > 32 && at_ + 1 < end_ && isDigit(at_[1])) {
    // A symbol in an address's place.
    ++at_;
    while (at_ < end_ && (isDigit(*at_) || *at_ == '.'))
      ++at_;
    issue(SyntaxIssueKind::SymbolAsAddress, begin, at_);
    return;
  }
  // A run of bytes that mean nothing is one issue.
  ++at_;
  while (at_ < end_ && (uint8_t(*at_) >= 128 || (*at_ == *begin && *at_ != '#')))
    ++at_;
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

/// `#1 = …`, `#[#2 + 1] = …`
void Scanner::scanAssignment() {
  const char *begin = at_;
  Item item;
  item.kind = ItemKind::Assignment;
  item.wordsBefore = uint16_t(block_.words.size());
  item.begin = offset(begin);
  item.target = expression(MacroExpression::Form::VariableNumber);
  // What it is called, without its marks.
  const bool marked = begin + 1 < at_ && begin[1] == '<';
  item.nameBegin = offset(begin) + (marked ? 2 : 1);
  item.nameEnd = std::max(item.nameBegin, offset(at_) - (marked ? 1 : 0));
  skipBlanks();
  if (at_ < end_ && *at_ == '=') {
    ++at_;
    item.value = expression(MacroExpression::Form::Full);
    item.end = offset(at_);
    block_.items.push_back(item);
    return;
  }
  issue(SyntaxIssueKind::BadStatement, begin, at_ > begin ? at_ : begin + 1);
  if (at_ == begin)
    ++at_;
}

namespace {

enum class FlowWord : uint8_t {
  None,
  Sub,
  EndSub,
  Return,
  Call,
  If,
  ElseIf,
  Else,
  EndIf,
  While,
  EndWhile,
  Do,
  Repeat,
  EndRepeat,
  Break,
  Continue
};

FlowWord flowWord(llvm::StringRef text) {
  return llvm::StringSwitch<FlowWord>(text)
      .CaseLower("sub", FlowWord::Sub)
      .CaseLower("endsub", FlowWord::EndSub)
      .CaseLower("return", FlowWord::Return)
      .CaseLower("call", FlowWord::Call)
      .CaseLower("if", FlowWord::If)
      .CaseLower("elseif", FlowWord::ElseIf)
      .CaseLower("else", FlowWord::Else)
      .CaseLower("endif", FlowWord::EndIf)
      .CaseLower("while", FlowWord::While)
      .CaseLower("endwhile", FlowWord::EndWhile)
      .CaseLower("do", FlowWord::Do)
      .CaseLower("repeat", FlowWord::Repeat)
      .CaseLower("endrepeat", FlowWord::EndRepeat)
      .CaseLower("break", FlowWord::Break)
      .CaseLower("continue", FlowWord::Continue)
      .Default(FlowWord::None);
}

Structure structureOf(FlowWord word) {
  switch (word) {
  case FlowWord::If:
    return Structure::If;
  case FlowWord::ElseIf:
    return Structure::ElseIf;
  case FlowWord::Else:
    return Structure::Else;
  case FlowWord::EndIf:
    return Structure::EndIf;
  case FlowWord::While:
    return Structure::While;
  case FlowWord::EndWhile:
    return Structure::EndWhile;
  case FlowWord::Do:
    return Structure::Repeat;
  case FlowWord::Repeat:
    return Structure::Times;
  case FlowWord::EndRepeat:
    return Structure::EndTimes;
  case FlowWord::Break:
    return Structure::Break;
  case FlowWord::Continue:
    return Structure::Continue;
  case FlowWord::Sub:
    return Structure::Sub;
  case FlowWord::EndSub:
    return Structure::EndSub;
  default:
    return Structure::Return;
  }
}

} // namespace

/// The expression in brackets that is here; `noExpression` when there is none.
uint16_t Scanner::bracketIfAny() {
  skipBlanks();
  return at_ < end_ && *at_ == '[' ? expression(MacroExpression::Form::Operand) : noExpression;
}

void Scanner::scanCallArguments(Item &item) {
  for (uint16_t value = bracketIfAny(); value != noExpression; value = bracketIfAny()) {
    Argument argument;
    argument.kind = ArgumentKind::Expression;
    argument.expression = value;
    argument.begin = block_.expressions[value].begin;
    argument.end = block_.expressions[value].end;
    block_.arguments.push_back(argument);
    ++item.arguments;
  }
}

/// An O-word: `o100 sub`, `o<name> call [1] [2]`, `o101 if [#1 GT 2]`; without a keyword it is the
/// header of a numbered program.
void Scanner::scanFlowWord() {
  const char *begin = at_++;
  skipBlanks();
  Item item = itemAt(ItemKind::Structure, begin);
  const char *name = at_, *nameEnd = at_;
  if (at_ < end_ && isDigit(*at_)) {
    while (at_ < end_ && isDigit(*at_))
      ++at_;
    nameEnd = at_;
  } else if (at_ < end_ && *at_ == '<') {
    name = ++at_;
    while (!atLineEnd() && *at_ != '>')
      ++at_;
    nameEnd = at_;
    if (atLineEnd())
      return issue(SyntaxIssueKind::BadStatement, begin, at_);
    ++at_;
  } else if (at_ < end_ && (*at_ == '[' || *at_ == '#')) {
    item.value = expression(MacroExpression::Form::Operand);
  } else {
    at_ = begin + 1;
    return issue(SyntaxIssueKind::MissingValue, begin, at_);
  }
  skipBlanks();
  const char *const keyword = at_;
  // Blanks do not count: `else if` is `elseif`.
  llvm::SmallString<12> letters;
  for (const char *p = at_; p < end_ && (isLetter(*p) || classOf(*p) == Blank); ++p)
    if (isLetter(*p)) {
      letters += *p;
      at_ = p + 1;
    }
  const FlowWord word = flowWord(letters);
  if (at_ == keyword && nameEnd > name) { // the header of a numbered program
    block_.kind = BlockKind::ProgramHeader;
    block_.headerBegin = offset(begin);
    block_.headerEnd = offset(at_);
    int64_t number = -1;
    if (llvm::StringRef(name, size_t(nameEnd - name)).getAsInteger(10, number))
      number = -1;
    block_.program = number;
    if (!isDigit(*name)) {
      block_.nameBegin = offset(name);
      block_.nameEnd = offset(nameEnd);
    }
    return;
  }
  if (word == FlowWord::None || (nameEnd == name && word != FlowWord::Call))
    return issue(SyntaxIssueKind::BadStatement, begin, at_);
  const llvm::StringRef label(name, size_t(nameEnd - name));
  item.structure = structureOf(word);
  item.label = uint32_t(llvm::xxHash64(flowLabel(label))) | 1;
  nameItem(item, label);
  switch (word) {
  case FlowWord::Call:
    item.kind = ItemKind::Call;
    item.positional = true;
    item.firstArgument = uint16_t(block_.arguments.size());
    scanCallArguments(item);
    break;
  case FlowWord::If:
  case FlowWord::ElseIf:
  case FlowWord::While:
    if (skipBlanks(); at_ >= end_ || *at_ != '[')
      break; // what is here is reported below
    item.condition = expression(MacroExpression::Form::Operand);
    break;
  case FlowWord::Repeat:
    item.target = constant(begin, at_, double(elementKey(variableKey("repeat "), offset(begin))));
    item.value = expression(MacroExpression::Form::Operand);
    break;
  case FlowWord::Sub:
    block_.labelBegin = offset(name);
    block_.labelEnd = offset(nameEnd);
    break;
  case FlowWord::EndSub:
  case FlowWord::Return:
    item.value = bracketIfAny();
    break;
  default:
    break;
  }
  add(item);
  skipBlanks();
  if (!atLineEnd() && *at_ != '(' && *at_ != ';') { // nothing else is beside an O-word
    const char *rest = at_;
    while (!atLineEnd() && *at_ != '(' && *at_ != ';')
      ++at_;
    issue(SyntaxIssueKind::BadStatement, rest, at_);
  }
}

/// Statements of Macro B that begin with a letter; false when there is none here.
bool Scanner::scanStatement() {
  const auto keyword = [&](llvm::StringRef word) {
    if (size_t(end_ - at_) < word.size())
      return false;
    return llvm::StringRef(at_, word.size()).equals_insensitive(word);
  };
  const char *begin = at_;
  Item item;
  item.begin = offset(begin);
  item.wordsBefore = uint16_t(block_.words.size());
  const auto skipOver = [&](size_t length) {
    at_ += length;
    skipBlanks();
  };
  const auto loopNumber = [&] {
    unsigned number = 0;
    skipBlanks();
    while (at_ < end_ && isDigit(*at_)) {
      number = std::min(255u, number * 10 + unsigned(*at_ - '0'));
      ++at_;
    }
    return uint8_t(number);
  };
  switch (*begin & ~32) {
  case 'I':
    if (!keyword("IF"))
      return false;
    skipOver(2);
    if (at_ >= end_ || *at_ != '[') {
      at_ = begin;
      return false;
    }
    item.kind = ItemKind::If;
    item.condition = expression(MacroExpression::Form::Operand);
    break;
  case 'T':
    if (!keyword("THEN"))
      return false;
    at_ += 4;
    return true;
  case 'G':
    if (!keyword("GOTO") && !keyword("GO TO"))
      return false;
    skipOver(keyword("GOTO") ? 4 : 5);
    item.kind = ItemKind::Jump;
    item.value = expression(MacroExpression::Form::Operand);
    break;
  case 'W':
    if (!keyword("WHILE"))
      return false;
    skipOver(5);
    item.kind = ItemKind::While;
    item.condition = expression(MacroExpression::Form::Operand);
    skipBlanks();
    if (keyword("DO")) {
      at_ += 2;
      item.loop = loopNumber();
    }
    break;
  case 'D':
    if (keyword("DPRNT")) {
      item.kind = ItemKind::Output;
      at_ = lineEnd();
      break;
    }
    if (!keyword("DO"))
      return false;
    at_ += 2;
    item.kind = ItemKind::Do;
    item.loop = loopNumber();
    break;
  case 'E':
    if (!keyword("END"))
      return false;
    at_ += 3;
    item.kind = ItemKind::End;
    item.loop = loopNumber();
    break;
  case 'P':
    if (!keyword("POPEN") && !keyword("PCLOS"))
      return false;
    item.kind = ItemKind::Output;
    at_ += 5;
    break;
  case 'B':
    if (!keyword("BPRNT"))
      return false;
    item.kind = ItemKind::Output;
    at_ = lineEnd();
    break;
  case 'S':
    if (!keyword("SETVN"))
      return false;
    item.kind = ItemKind::Output;
    at_ = lineEnd();
    break;
  default:
    return false;
  }
  item.end = offset(at_);
  block_.items.push_back(item);
  return true;
}

} // namespace

IsoReader::IsoReader(const Dialect &dialect, llvm::StringRef text)
    : Reader(text), lexical_(dialect.lexical) {
  symbols_.fill(noAddress);
  for (size_t i = 0; i < dialect.addressNames.size(); ++i)
    // `@n`: the character is the address.
    if (const std::string &name = dialect.addressNames[i]; name.size() == 2 && name[1] == 'n' &&
                                                           uint8_t(name[0]) < symbols_.size() &&
                                                           !llvm::isAlnum(name[0]))
      symbols_[uint8_t(name[0])] = AddressId(firstNamed + i);
}

std::string IsoReader::labelKey(llvm::StringRef label) const { return flowLabel(label); }

namespace {

/// So many things wrong that one report of the whole says more than one of each.
constexpr size_t leastGarbage = 3;
/// Bytes of a short word in a script of two or three bytes a letter.
constexpr uint32_t foreignWord = 5;

/// A line of prose, or of another control's language: it is one issue, and nothing in it is code.
void collapseProse(Block &block) {
  size_t garbage = 0;
  for (const SyntaxIssue &issue : block.issues)
    switch (issue.kind) {
    case SyntaxIssueKind::InvalidCharacter:
      // A long run of foreign letters is text by itself.
      garbage += 1 + (issue.end - issue.begin) / foreignWord;
      break;
    case SyntaxIssueKind::SymbolAsAddress:
    case SyntaxIssueKind::MissingValue:
    case SyntaxIssueKind::MissingAddress:
    case SyntaxIssueKind::StrayParenthesis:
    case SyntaxIssueKind::UnbalancedBracket:
    case SyntaxIssueKind::BadStatement:
    case SyntaxIssueKind::UnknownWord:
      ++garbage;
      break;
    default:
      break;
    }
  if (garbage < leastGarbage)
    return;
  const uint32_t begin = block.issues.front().begin;
  block.words.clear();
  block.items.clear();
  block.addresses = 0;
  block.issues.clear();
  block.issues.push_back({SyntaxIssueKind::NotABlock, std::min(begin, block.end), block.end});
}

} // namespace

void IsoReader::read(uint32_t offset, Block &block) const {
  block.clear();
  Scanner(lexical_, symbols_, text_, offset, block).scan();
  if (!block.issues.empty())
    collapseProse(block);
}

} // namespace ncvet
