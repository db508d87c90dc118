// Reader of MEFI programs: a block runs from one `N` to the next, over any number of lines.
#include "formats/readers/mefi/mefi_reader.h"

#include "formats/readers/block_scanner.h"

#include "llvm/ADT/StringExtras.h"

#include <algorithm>

namespace ncvet {

namespace {

/// Digits that a number may have; more do not fit into a mantissa.
constexpr unsigned maxDigits = 18;
/// Larger block numbers are cut.
constexpr int64_t maxNumber = 1'000'000'000'000;
/// Quotation marks of a word processor: U+201C to U+201E in UTF-8, and the same in Windows-1250 and
/// 1252. No character of UTF-8 begins with these bytes.
constexpr llvm::StringLiteral typographicQuotes[] = {"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E",
                                                     "\x93",         "\x94",         "\x84"};
/// Dashes that look like a minus: U+2010 to U+2015 and U+2212 in UTF-8, the two of Windows.
constexpr llvm::StringLiteral dashes[] = {"\xE2\x80\x90", "\xE2\x80\x91", "\xE2\x80\x92",
                                          "\xE2\x80\x93", "\xE2\x80\x94", "\xE2\x80\x95",
                                          "\xE2\x88\x92", "\x96",         "\x97"};

/// Between words: a block goes on over the ends of lines.
bool isGap(char c) { return isLineBlank(c) || isLineEnd(c); }
bool isNameLetter(char c) { return llvm::isAlpha(c) || c == '_'; }

class Scanner : BlockScanner<isGap> {
public:
  Scanner(const Dialect &dialect, llvm::StringRef text, uint32_t offset, Block &block)
      : BlockScanner(text, offset, block), dialect_(dialect) {}

  void scan() {
    block_.begin = offset(at_);
    if (startsBlock())
      scanNumberOfBlock();
    else
      leading_ = true;
    while (at_ < end_ && !startsBlock())
      scanItem();
    finish();
  }

private:
  llvm::StringRef rest() const { return {at_, size_t(end_ - at_)}; }
  /// A letter N that no name holds and no name begins with.
  bool startsBlock() const {
    return at_ < end_ && (*at_ == 'N' || *at_ == 'n') && (at_ + 1 == end_ || !isNameLetter(at_[1]));
  }
  void scanNumberOfBlock();
  void scanItem();
  void scanComment();
  void scanName();
  void scanCall(const char *begin, const char *end);
  void scanAssignment(const char *begin, const char *end);
  void scanWord();
  void scanOther();
  bool scanNumber(Word &word, const char *begin, bool commaIsPoint = true);
  bool readsAsZero(const char *p) const;
  bool scanLetterNumber();
  bool isParameter(llvm::StringRef name) const;
  uint16_t key(const char *begin, const char *end);
  uint16_t valueOf(const Word &word);
  void finish();

  const Dialect &dialect_;
  const char *content_ = nullptr; ///< after the last byte that is no blank
  bool leading_ = false;          ///< is before the first N
};

/// The key of the variable with this name, as an expression.
uint16_t Scanner::key(const char *begin, const char *end) {
  return constant(begin, end, double(variableKey({begin, size_t(end - begin)})));
}

/// The number of `word`, which ends here.
uint16_t Scanner::valueOf(const Word &word) {
  const char *const begin = base_ + word.offset;
  return word.isNumber() ? constant(begin, at_, word.value()) : opaque(begin, at_);
}

void Scanner::scanNumberOfBlock() {
  const char *const begin = at_++;
  content_ = at_;
  block_.numberBegin = offset(begin);
  block_.numberEnd = offset(at_);
  if (at_ < end_ && (*at_ == '-' || *at_ == '+')) {
    const char *p = at_ + 1;
    int64_t number = 0;
    for (; p < end_ && llvm::isDigit(*p); ++p)
      number = number < maxNumber ? number * 10 + (*p - '0') : number;
    block_.number = number;
    block_.numberEnd = offset(p);
    at_ = content_ = p;
    issue(SyntaxIssueKind::MalformedNumber, begin, p);
    return;
  }
  const char *const digits = at_;
  int64_t number = 0;
  while (at_ < end_ && llvm::isDigit(*at_)) {
    if (at_ - digits < ptrdiff_t(maxDigits))
      number = number * 10 + (*at_ - '0');
    ++at_;
  }
  if (at_ > digits)
    block_.number = number;
  if (at_ < end_ && *at_ == '.') {
    while (at_ < end_ && (llvm::isDigit(*at_) || *at_ == '.'))
      ++at_;
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  }
  block_.numberEnd = offset(at_);
  content_ = at_;
}

void Scanner::scanItem() {
  const char c = *at_;
  if (isGap(c)) {
    ++at_;
    return;
  }
  if (c == '"') {
    scanComment();
  } else if (llvm::isAlpha(c)) {
    block_.lowerCase |= c >= 'a' && c <= 'z';
    if (at_ + 1 < end_ && isNameLetter(at_[1])) {
      if (!scanLetterNumber())
        scanName();
    } else {
      scanWord();
    }
  } else {
    scanOther();
  }
  content_ = at_;
}

/// To the end of the line.
void Scanner::scanComment() {
  const char *const begin = at_;
  while (at_ < end_ && *at_ != '\n' && *at_ != '\r')
    ++at_;
  block_.comments.push_back({offset(begin), offset(at_)});
}

void Scanner::scanName() {
  const char *const begin = at_;
  while (at_ < end_ && (llvm::isAlnum(*at_) || *at_ == '_'))
    ++at_;
  const char *const end = at_;
  const char *behind = at_;
  while (behind < end_ && (*behind == ' ' || *behind == '\t'))
    ++behind;
  if (behind < end_ && *behind == '=') {
    at_ = behind + 1;
    scanAssignment(begin, end);
    return;
  }
  CodeIndex code = dialect_.keyword({begin, size_t(end - begin)});
  // A call has an entry for each program that it may name: `CALLCYCLE(CYC_COPY)`.
  if (behind < end_ && *behind == '(') {
    const llvm::StringRef rest(behind + 1, size_t(end_ - behind - 1));
    const llvm::StringRef name =
        rest.ltrim(" \t").take_while([](char c) { return llvm::isAlnum(c) || c == '_'; });
    const CodeIndex named = dialect_.keyword(
        (llvm::Twine(llvm::StringRef(begin, size_t(end - begin))) + "(" + name + ")").str());
    if (!name.empty() && named != noCode)
      code = named;
  }
  if (code == noCode) {
    if (behind < end_ && *behind == '(') {
      at_ = behind;
      scanCall(begin, end);
    }
    issue(SyntaxIssueKind::UnknownWord, begin, end);
    return;
  }
  Word word;
  word.address = keywordAddress;
  word.offset = offset(begin);
  word.length = uint8_t(std::min<ptrdiff_t>(end - begin, 255));
  word.mantissa = code;
  append(word);
  if (behind < end_ && *behind == '(') {
    at_ = behind;
    scanCall(begin, end);
  }
}

/// `(arg, arg)`: numbers and names.
void Scanner::scanCall(const char *begin, const char *end) {
  Item item;
  item.kind = ItemKind::Instruction;
  item.wordsBefore = uint16_t(block_.words.size());
  item.begin = item.nameBegin = offset(begin);
  item.nameEnd = offset(end);
  item.firstArgument = uint16_t(block_.arguments.size());
  ++at_; // the parenthesis
  bool closed = false;
  for (char separator = 0; at_ < end_ && !closed;) {
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\t'))
      ++at_;
    Argument argument;
    argument.separator = separator;
    const char *const from = at_;
    argument.begin = argument.end = offset(from);
    Word word;
    word.address = argumentAddress;
    word.offset = offset(from);
    if (at_ < end_ && (llvm::isDigit(*at_) || *at_ == '-' || *at_ == '+' || *at_ == '.')) {
      scanNumber(word, from, /*commaIsPoint=*/false);
      word.length = uint8_t(std::min<ptrdiff_t>(at_ - from, 255));
      argument.kind = ArgumentKind::Expression;
      argument.expression = valueOf(word);
    } else if (at_ < end_ && isNameLetter(*at_)) {
      while (at_ < end_ && (llvm::isAlnum(*at_) || *at_ == '_'))
        ++at_;
      argument.kind = ArgumentKind::Name;
      word.length = uint8_t(std::min<ptrdiff_t>(at_ - from, 255));
      word.mantissa = key(from, at_);
      word.flags |= wordExpression;
    } else {
      word.flags |= wordNoValue;
    }
    argument.end = offset(at_);
    while (at_ < end_ && (*at_ == ' ' || *at_ == '\t'))
      ++at_;
    const bool comma = at_ < end_ && *at_ == ',';
    closed = at_ < end_ && *at_ == ')';
    if (argument.kind != ArgumentKind::Empty || comma || separator) {
      block_.arguments.push_back(argument);
      ++item.arguments;
      append(word);
    }
    if (!comma && !closed)
      break;
    separator = ',';
    ++at_;
  }
  if (!closed)
    issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
  item.end = offset(at_);
  block_.items.push_back(item);
}

/// `name = value`, the value a number or a name.
void Scanner::scanAssignment(const char *begin, const char *end) {
  while (at_ < end_ && (*at_ == ' ' || *at_ == '\t'))
    ++at_;
  Word word;
  word.address = variableAddress;
  word.offset = offset(begin);
  const char *const value = at_;
  bool known = true;
  if (at_ < end_ && llvm::isAlpha(*at_) && !startsBlock() && at_ + 1 < end_ &&
      isNameLetter(at_[1])) {
    while (at_ < end_ && (llvm::isAlnum(*at_) || *at_ == '_'))
      ++at_;
    word.mantissa = key(value, at_);
    word.flags |= wordExpression;
  } else {
    known = scanNumber(word, begin);
  }
  if (!known) {
    word.flags |= wordNoValue;
    issue(SyntaxIssueKind::MissingValue, begin, at_);
  }
  word.length = uint8_t(std::min<ptrdiff_t>(at_ - begin, 255));
  Item item;
  item.kind = ItemKind::Assignment;
  item.wordsBefore = uint16_t(block_.words.size());
  item.begin = offset(begin);
  item.end = offset(at_);
  item.nameBegin = item.begin;
  item.nameEnd = offset(end);
  item.target = key(begin, end);
  item.value = word.has(wordExpression) ? uint16_t(word.mantissa) : valueOf(word);
  block_.items.push_back(item);
  append(word);
}

/// A letter and its number; `R30 = 2` is an assignment.
void Scanner::scanWord() {
  const char *const begin = at_;
  const AddressId address = letterAddress(llvm::toUpper(*at_++));
  if (address == letterAddress('R')) {
    const char *p = at_;
    while (p < end_ && llvm::isDigit(*p))
      ++p;
    const char *behind = p;
    while (behind < end_ && (*behind == ' ' || *behind == '\t'))
      ++behind;
    if (p > at_ && behind < end_ && *behind == '=') {
      at_ = behind + 1;
      scanAssignment(begin, p);
      return;
    }
    // `R31-15`, `R28 4`: the sign that gives the parameter its value is missing.
    const char *digit = behind;
    while (digit < end_ && (*digit == '-' || *digit == '+'))
      ++digit;
    if (digit > p && p > at_ && digit < end_ && llvm::isDigit(*digit) &&
        isParameter({begin, size_t(p - begin)})) {
      at_ = behind;
      scanAssignment(begin, p);
      issue(SyntaxIssueKind::MissingEquals, begin, at_);
      return;
    }
  }
  Word word;
  word.address = address;
  word.offset = offset(begin);
  while (at_ < end_ && (*at_ == ' ' || *at_ == '\t'))
    ++at_;
  if (!scanNumber(word, begin)) {
    at_ = begin + 1;
    word.flags |= wordNoValue;
    issue(SyntaxIssueKind::MissingValue, begin, at_);
  }
  word.length = uint8_t(std::min<ptrdiff_t>(at_ - begin, 255));
  append(word);
}

/// A letter O among the digits of a number, up to whose end nothing but O, digits and a point
/// are.
bool Scanner::readsAsZero(const char *p) const {
  if (p >= end_ || (*p != 'O' && *p != 'o') ||
      dialect_.addresses[letterAddress('O')].kind != AddressKind::Unknown)
    return false;
  while (p < end_ && (*p == 'O' || *p == 'o' || *p == '.' || llvm::isDigit(*p)))
    ++p;
  return p == end_ || (!isNameLetter(*p) && *p != '=' && *p != '(');
}

/// An address and a number that begins with the letter O: `GO`, `MO5`, `XO.5`; false, with nothing
/// read, when it is a name.
bool Scanner::scanLetterNumber() {
  const char *const begin = at_;
  const AddressId address = letterAddress(llvm::toUpper(*at_));
  if (address == letterAddress('N') || !(dialect_.known & maskOf(address)) || !readsAsZero(at_ + 1))
    return false;
  while (++at_ < end_ && (*at_ == 'O' || *at_ == 'o' || *at_ == '.' || llvm::isDigit(*at_)))
    ;
  const char *behind = at_;
  while (behind < end_ && (*behind == ' ' || *behind == '\t'))
    ++behind;
  if (behind < end_ && (*behind == '=' || *behind == '(')) {
    at_ = begin;
    return false;
  }
  issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  Word word;
  word.address = address;
  word.offset = offset(begin);
  word.flags |= wordNoValue | wordMalformed;
  word.length = uint8_t(std::min<ptrdiff_t>(at_ - begin, 255));
  append(word);
  return true;
}

/// A variable of a letter and digits that some code reads.
bool Scanner::isParameter(llvm::StringRef name) const {
  const uint64_t wanted = variableKey(name);
  return llvm::any_of(dialect_.codes, [&](const CodeInfo &code) {
    return llvm::any_of(code.words, [&](const WordSpec &w) { return w.variable == wanted; });
  });
}

/// `[sign] digits [. digits]`; false, with nothing read, when there is no digit.
bool Scanner::scanNumber(Word &word, const char *begin, bool commaIsPoint) {
  const char *p = at_;
  bool negative = false;
  for (const llvm::StringRef dash : dashes)
    if (rest().startswith(dash)) {
      issue(SyntaxIssueKind::TypographicMinus, p, p + dash.size());
      p += dash.size();
      negative = true;
      break;
    }
  if (p == at_ && p < end_ && (*p == '-' || *p == '+')) {
    negative = *p == '-';
    if (!negative)
      word.flags |= wordPlus;
    ++p;
  }
  const char *const sign = p;
  while (p > at_ && p < end_ && (*p == '-' || *p == '+'))
    ++p;
  const bool signsTwice = p > sign;
  const char *const first = p;
  int64_t mantissa = 0;
  unsigned digits = 0, decimals = 0;
  const auto take = [&] {
    for (; p < end_ && llvm::isDigit(*p); ++p)
      if (digits < maxDigits) {
        mantissa = mantissa * 10 + (*p - '0');
        ++digits;
      } else {
        word.flags |= wordMalformed;
      }
  };
  take();
  const unsigned whole = digits;
  bool bad = false;
  if (p < end_ &&
      (*p == '.' || (commaIsPoint && *p == ',' && p + 1 < end_ && llvm::isDigit(p[1])))) {
    const bool comma = *p == ',';
    const char *const point = p++;
    take();
    decimals = digits - whole;
    word.flags |= wordPoint;
    if (comma)
      issue(SyntaxIssueKind::DecimalComma, begin, p);
    bad = point + 1 == p && whole == 0;
  }
  if (digits == 0)
    return false;
  // A second point or sign, or the letter O for a zero.
  const auto goesOn = [&] {
    return p < end_ &&
           (*p == '.' || *p == '-' || *p == '+' || (commaIsPoint && *p == ',') || readsAsZero(p));
  };
  if (goesOn() || bad || signsTwice) {
    while (p < end_ && (goesOn() || llvm::isDigit(*p)))
      ++p;
    issue(SyntaxIssueKind::MalformedNumber, begin, p);
    word.flags |= wordMalformed;
  }
  if (negative)
    word.flags |= wordMinus;
  if (whole > 1 && *first == '0')
    word.flags |= wordLeadingZero;
  word.mantissa = negative ? -mantissa : mantissa;
  word.decimals = uint8_t(decimals);
  at_ = p;
  return true;
}

/// What is neither a comment nor letters nor a number after its letter.
void Scanner::scanOther() {
  for (const llvm::StringRef quote : typographicQuotes)
    if (rest().startswith(quote)) {
      issue(SyntaxIssueKind::TypographicQuote, at_, at_ + quote.size());
      scanComment();
      return;
    }
  const char *const begin = at_;
  if (*at_ == '(' || *at_ == ';') {
    // A comment of another control: what it holds is not code.
    const char close = *at_ == '(' ? ')' : '\n';
    while (at_ < end_ && *at_ != close && *at_ != '\n' && *at_ != '\r')
      ++at_;
    if (at_ < end_ && *at_ == ')')
      ++at_;
    issue(SyntaxIssueKind::ForeignComment, begin, at_);
    return;
  }
  if (llvm::isDigit(*at_) || *at_ == '-' || *at_ == '+' || *at_ == '.') {
    while (at_ < end_ && (llvm::isDigit(*at_) || *at_ == '-' || *at_ == '+' || *at_ == '.'))
      ++at_;
    issue(SyntaxIssueKind::MissingAddress, begin, at_);
    return;
  }
  while (at_ < end_ && !isGap(*at_) && !llvm::isAlnum(*at_) && *at_ != '"' && *at_ != '(' &&
         *at_ != ';' && (at_ == begin || (*at_ != '-' && *at_ != '+' && *at_ != '.')))
    ++at_;
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

void Scanner::finish() {
  block_.next = offset(at_);
  block_.end = content_ ? offset(content_) : block_.begin;
  if (!leading_)
    return; // a bare N is a block
  if (block_.isEmpty() && block_.issues.empty())
    block_.kind = BlockKind::Empty;
  else
    issue(SyntaxIssueKind::OutsideBlock, base_ + block_.begin, base_ + block_.end);
}

} // namespace

void MefiReader::read(uint32_t offset, Block &block) const {
  block.clear();
  Scanner(dialect_, text_, offset, block).scan();
}

} // namespace ncvet
