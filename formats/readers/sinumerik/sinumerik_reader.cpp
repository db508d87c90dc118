// Reader of Sinumerik programs: blocks, what is before their words, archive headers.
#include "formats/readers/sinumerik/sinumerik_reader.h"

#include "formats/dialect/control_facts.h"
#include "formats/readers/alike_block.h"
#include "formats/readers/block_limit.h"
#include "formats/readers/empty_lines.h"
#include "formats/readers/sinumerik/sinumerik_scanner.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet {

/// The code that is called by this name; none when a program of the project hides it.
CodeIndex SinumerikScanner::codeNamed(llvm::StringRef name) const {
  const CodeIndex code = dialect_.keyword(name);
  return code != noCode && dialect_.codes[code].isProgram && reader_.isHidden(name) ? noCode : code;
}

void SinumerikScanner::scan() {
  block_.begin = offset(at_);
  const char *content = at_;
  skipBlanks();
  if (at_ < end_ && *at_ == '%') {
    scanHeader();
    content = at_;
  } else {
    scanSkip();
    while (at_ < end_ && !isLineEnd(*at_)) {
      if (isSinumerikBlank(*at_)) {
        ++at_;
        continue;
      }
      scanItem();
      content = at_;
    }
  }
  block_.end = offset(std::max(content, base_ + block_.begin));
  takeLineEnd();
  if (isProse())
    dropProse();
  if (block_.kind == BlockKind::Normal && block_.isEmpty() && block_.issues.empty() &&
      block_.number < 0 && block_.skip < 0 && !block_.hasLabel())
    block_.kind = BlockKind::Empty;
}

/// Three names in a row that nothing follows are no calls: a block calls one program.
bool SinumerikScanner::isProse() const {
  constexpr ptrdiff_t fewest = 3;
  return llvm::count_if(block_.items, [](const Item &item) {
           return item.kind == ItemKind::Call && !item.arguments && item.count == noExpression &&
                  !item.modal && !item.external;
         }) >= fewest;
}

/// Nothing in the block is code.
void SinumerikScanner::dropProse() {
  const uint32_t begin = block_.items.front().begin;
  block_.words.clear();
  block_.items.clear();
  block_.issues.clear();
  block_.addresses = block_.repeated = block_.pointed = block_.pointless = 0;
  block_.issues.push_back({SyntaxIssueKind::NotABlock, begin, block_.end});
}

/// `/`, `/3`: before everything else.
void SinumerikScanner::scanSkip() {
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

void SinumerikScanner::scanItem() {
  const char c = *at_;
  if (isLetter(c))
    return scanLetter();
  if (c == ';')
    return scanComment();
  if (c == '_')
    return scanName();
  scanOther();
}

void SinumerikScanner::scanComment() {
  const char *const begin = at_;
  at_ = lineEnd();
  block_.comments.push_back({offset(begin), offset(at_)});
}

/// `%_N_SHAFT_MPF`, `%SHAFT_SPF`: the file as the control stores it. Any other `%` is none.
void SinumerikScanner::scanHeader() {
  const char *const begin = at_++;
  llvm::StringRef name = identifier();
  at_ = name.end();
  const bool unit = name.startswith_insensitive("_N_");
  if (unit)
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
    if (const char *const after = afterBlanks(at_);
        (after == end_ || isLineEnd(*after) || *after == ';') &&
        (isData(name) || (unit && isFiled(after))))
      return skipUnit();
  }
  rest();
  if (!atLineEnd())
    scanComment();
}

/// `INITIAL_INI`: a unit of an archive that holds data of the control, masks of its screen, or
/// what only the control itself can read.
bool SinumerikScanner::isData(llvm::StringRef name) const {
  const llvm::StringRef kind = name.rsplit('_').second;
  return llvm::any_of(dialect_.facts->program.dataKinds,
                      [&](llvm::StringRef one) { return kind.equals_insensitive(one); });
}

/// Whether the line after the head says where the unit is filed: it is one of an archive, of a kind
/// that is no program.
bool SinumerikScanner::isFiled(const char *p) const {
  while (p < end_ && !isLineEnd(*p))
    ++p;
  while (p < end_ && isLineEnd(*p))
    ++p;
  return llvm::StringRef(p, size_t(end_ - p)).startswith(";$PATH=");
}

/// The whole unit is one block, which holds nothing: it ends with the line before the next head.
void SinumerikScanner::skipUnit() {
  const llvm::StringRef rest(at_, size_t(end_ - at_));
  size_t next = rest.find("%_N_");
  while (next != llvm::StringRef::npos && (next == 0 || !isLineEnd(rest[next - 1])))
    next = rest.find("%_N_", next + 1);
  if (next == llvm::StringRef::npos) {
    at_ = end_;
    return;
  }
  --next; // the end of the line before it
  next -= rest[next] == '\n' && next > 0 && rest[next - 1] == '\r';
  at_ = rest.data() + next;
}

/// The wide colon of Chinese texts, in UTF-8 and in GBK, and what remains of it where the text was
/// converted once more. Each begins with one of two bytes.
static constexpr llvm::StringLiteral wideColons[] = {"\xEF\xBC\x9A", "\xA3\xBA",
                                                     "\xEF\xBF\xBD\xEF\xBF\xBD"};

/// The wide colon at the head of `text`; empty: there is none.
static llvm::StringRef wideColonAt(llvm::StringRef text) {
  for (const llvm::StringLiteral &colon : wideColons)
    if (text.startswith(colon))
      return text.take_front(colon.size());
  return {};
}

/// `NAME:` before everything but the number. That of a wide colon is meant as one.
bool SinumerikScanner::scanLabel() {
  if (!startsBlock() || block_.hasLabel())
    return false;
  const llvm::StringRef name = identifier();
  if (name.end() == end_)
    return false;
  const llvm::StringRef colon =
      *name.end() == ':' ? llvm::StringRef(name.end(), 1)
                         : wideColonAt(llvm::StringRef(name.end(), size_t(end_ - name.end())));
  if (colon.empty())
    return false;
  block_.labelBegin = offset(name.begin());
  block_.labelEnd = offset(name.end());
  at_ = colon.end();
  if (colon.size() > 1)
    issue(SyntaxIssueKind::InvalidCharacter, colon.begin(), colon.end());
  if (sinumerikKeyword(name) != SinumerikKeyword::None)
    issue(SyntaxIssueKind::BadName, name.begin(), name.end());
  return true;
}

/// `1PART P2`: the name of a program that begins with a digit.
bool SinumerikScanner::scanBadName() {
  constexpr size_t letters = 2; // one and a number are words
  const llvm::StringRef name = identifier();
  const llvm::StringRef rest = name.drop_while(isNumberDigit);
  if (!startsBlock() || rest.size() == name.size() || rest.size() < letters ||
      !llvm::all_of(rest.take_front(letters), isNameLetter))
    return false;
  at_ = name.end();
  issue(SyntaxIssueKind::BadName, name.begin(), at_);
  if (const char *const count = afterBlanks(at_);
      count < end_ && (*count | 32) == 'p' && count + 1 < end_ && isNumberDigit(count[1])) {
    at_ = count + 1;
    takeWhole();
  }
  return true;
}

void SinumerikScanner::scanNumberOfBlock(const char *begin) {
  setNumber(begin, takeWhole());
  if (at_ < end_ && *at_ == '.') {
    while (at_ < end_ && (isNumberDigit(*at_) || *at_ == '.'))
      ++at_;
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
  }
}

/// `"POCKETS"` at the begin of a block calls a program. A text that nothing takes is no code,
/// whatever it holds.
void SinumerikScanner::scanQuotes() {
  const char *const begin = at_;
  if (*at_ == '"') {
    Item item = itemAt(ItemKind::Call, begin);
    const bool called = startsBlock();
    const auto text = scanString();
    if (!text)
      return;
    if (called)
      return scanCall(*text, item);
  } else {
    do
      ++at_;
    while (!atLineEnd() && *at_ != '\'' && !isSinumerikBlank(*at_));
    at_ += !atLineEnd() && *at_ == '\'';
  }
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

/// A `=` or `[1]=` that belongs to no name, with the number after it.
void SinumerikScanner::skipValue() {
  const char *const begin = at_;
  skipIndices();
  if (*begin == '=' || isEquals(afterBlanks(at_)))
    at_ = afterBlanks(at_);
  const char *const sign = at_;
  while (at_ < end_ && *at_ == '=')
    ++at_;
  if (const char *const value = afterBlanks(at_);
      at_ > sign && value < end_ && (isNumberDigit(*value) || *value == '-')) {
    at_ = value;
    skipNumberCharacters();
  }
  const bool isOpen = *begin == '[' && !llvm::StringRef(begin, size_t(at_ - begin)).contains(']');
  issue(isOpen ? SyntaxIssueKind::UnbalancedBracket : SyntaxIssueKind::InvalidCharacter, begin,
        at_);
}

void SinumerikScanner::scanOther() {
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
  case '\'':
    return scanQuotes();
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
  case '[':
  case '=':
    return skipValue();
  case ')':
  case ']':
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
    return issue(startsBlock() && block_.number >= 0 ? SyntaxIssueKind::SkipInside
                                                     : SyntaxIssueKind::InvalidCharacter,
                 begin, at_);
  default:
    break;
  }
  if (isNumberDigit(*at_) && scanBadName())
    return;
  if (isNumberDigit(*at_) || *at_ == '.' || *at_ == '-' || *at_ == '+') {
    skipNumberCharacters();
    return issue(SyntaxIssueKind::MissingAddress, begin, at_);
  }
  ++at_;
  while (at_ < end_ && (uint8_t(*at_) >= 128 || *at_ == *begin))
    ++at_;
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

SinumerikReader::SinumerikReader(const Dialect &dialect, llvm::StringRef text)
    : QuickReader(text), dialect_(dialect) {
  for (size_t i = 0; i < dialect.addressNames.size(); ++i)
    addresses_[llvm::StringRef(dialect.addressNames[i]).upper()] = AddressId(firstNamed + i);
  // The editors write the head, and mark their blocks as read-only.
  const llvm::StringRef head = text.take_front(4096);
  for (const std::string &call : dialect.facts->program.stepHeads)
    steps_ |= head.contains_insensitive(call + "(");
}

/// `E_DR_SIN(..)`, `F_ROUGH(..)`: what a step does only the control's own editor knows.
void SinumerikReader::markSteps(Block &block) const {
  for (Item &item : block.items) {
    const llvm::StringRef name = text_.slice(item.nameBegin, item.nameEnd);
    if (item.kind == ItemKind::Call && name.size() > 2 && name[1] == '_' &&
        ((name[0] | 32) == 'e' || (name[0] | 32) == 'f') && text_[item.end - 1] == ')')
      item.external = true;
  }
}

void SinumerikReader::read(uint32_t offset, Block &block) const {
  block.clear();
  SinumerikScanner(*this, dialect_, addresses_, offset, block).scan();
  dropOversized(block);
  if (steps_)
    markSteps(block);
}

/// After the comment at `at`; `at`: it is none.
static const char *afterComment(const char *at, const char *end) {
  return *at == ';' ? findAny(at, end, '\n', '\r', '\n', '\r') : at;
}

bool SinumerikReader::isPattern(const Block &block) const { return isAlikePattern(block); }

bool SinumerikReader::readAlike(uint32_t offset, AddressMask free, Block &block) const {
  // `X10EX5` is a number with an exponent, `X1 =5` an address of two characters.
  // Without a sign `R5.2` is a variable and no word: only addresses take other numbers.
  constexpr AlikeGrammar grammar{false, false, false};
  // A reading that has failed leaves some words with the places of another block.
  assert(!block.words.empty() && block.comments.size() <= 1);
  return ncvet::readAlike<isSinumerikBlank, grammar>(
      text_, offset, free & dialect_.known, block,
      [&](const char *at) { return afterComment(at, text_.end()); });
}

bool SinumerikReader::mayHoldLabels(uint32_t begin, uint32_t end) const {
  constexpr size_t longest = 256; // bytes of a line up to its label; of a longer one it is not told
  const llvm::StringRef text = text_.slice(begin, end);
  for (const llvm::StringLiteral &colon : wideColons)
    if (text.contains(colon[0]) && text.contains(colon))
      return true;
  for (size_t colon = text.find(':'); colon != llvm::StringRef::npos;
       colon = text.find(':', colon + 1)) {
    const llvm::StringRef before = text.slice(colon > longest ? colon - longest : 0, colon);
    const size_t ended = before.find_last_of("\r\n");
    const llvm::StringRef line =
        ended == llvm::StringRef::npos ? before : before.drop_front(ended + 1);
    if (!line.empty() && !line.contains(';'))
      return true; // not in a comment
  }
  return false;
}

EmptyLines SinumerikReader::emptyLines(uint32_t offset, uint32_t limit) const {
  const char *const base = text_.begin(), *const end = base + limit;
  return passEmptyLines<isSinumerikBlank>(base, offset, limit,
                                          [&](const char *at) { return afterComment(at, end); });
}

} // namespace ncvet
