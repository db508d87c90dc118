// Reader of word-address programs (ISO 6983, DIN 66025): FANUC, Haas, NCT and their kin.
#include "formats/readers/iso/iso_reader.h"

#include "formats/readers/alike_block.h"
#include "formats/readers/block_limit.h"
#include "formats/readers/empty_lines.h"
#include "formats/readers/iso/iso_scanner.h"

#include <array>

namespace ncvet {

namespace {

enum CharClass : uint8_t { Other, Letter, LowerLetter, Blank, LineEnd };

constexpr std::array<CharClass, 256> makeClasses() {
  std::array<CharClass, 256> classes{};
  for (unsigned c = 'A'; c <= 'Z'; ++c)
    classes[c] = Letter;
  for (unsigned c = 'a'; c <= 'z'; ++c)
    classes[c] = LowerLetter;
  classes[' '] = classes['\t'] = classes['\v'] = classes['\f'] = classes[0] = Blank;
  classes['\n'] = classes['\r'] = LineEnd;
  return classes;
}
constexpr std::array<CharClass, 256> classes = makeClasses();

} // namespace

/// A word, or what else begins with a letter.
inline void IsoScanner::scanLetter() {
  const char *const begin = at_;
  const char upper = char(*at_ & ~32);
  if (upper == 'O' && lexical_.flowWords)
    return scanFlowWord();
  if (lexical_.indexedNames && end_ - at_ > 4 &&
      (at_[2] == '=' || at_[3] == '=' || at_[4] == '=') && scanIndexed())
    return;
  if (at_ + 1 < end_ && isLetter(at_[1])) {
    if (lexical_.flowWords ? upper == 'I' && scanForeignIf() : lexical_.macro && scanStatement())
      return;
    if (scanUnknownWord())
      return;
  }
  if (upper == 'O' && startsBlock()) {
    const char *const p = afterBlanks(at_ + 1);
    if (p < end_ && isNumberDigit(*p))
      return scanHeader(begin);
    if (p < end_ && *p == '<' && scanName(begin, p))
      return;
  }
  ++at_;
  scanWord(letterAddress(upper), begin);
}

void IsoScanner::scan() {
  block_.begin = offset(at_);
  skipBlanks();
  if (at_ < end_ && *at_ == '%') {
    scanTape();
  } else {
    while (at_ < end_) {
      switch (classes[uint8_t(*at_)]) {
      case Blank:
        ++at_;
        continue;
      case LowerLetter:
        block_.lowerCase = true;
        [[fallthrough]];
      case Letter:
        scanLetter();
        continue;
      case LineEnd:
        break;
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

void IsoScanner::scanOther() {
  const char *const begin = at_;
  if (const AddressId address = symbols_.addressOf(*at_); address != noAddress) {
    ++at_;
    return scanWord(address, begin);
  }
  if (!scanMark())
    scanStray();
}

/// A character with a meaning of its own; false, with nothing read, when it has none here.
bool IsoScanner::scanMark() {
  const char *const begin = at_;
  switch (*at_) {
  case '(':
    scanComment();
    return true;
  case ')':
    ++at_;
    issue(SyntaxIssueKind::StrayParenthesis, begin, at_);
    return true;
  case ';':
    scanLineComment();
    return true;
  case '/':
    return scanSkip();
  case ',':
    scanComma();
    return true;
  case '#':
    if (!lexical_.macro)
      return false;
    scanAssignment();
    return true;
  case ':':
    if (!startsBlock() || at_ + 1 == end_ || !isNumberDigit(at_[1]))
      return false;
    scanHeader(begin);
    return true;
  case '%':
    // `M30%` on one line: the tape mark ends the program here too.
    block_.tapeInside = true;
    at_ = lineEnd();
    return true;
  case '\x1A':
    return scanEndOfFile();
  case '<':
    return scanName(begin, begin);
  case '[':
    return scanBracket();
  case ']':
    ++at_;
    issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
    return true;
  default:
    return false;
  }
}

/// `[#<NAME>]`, or what no block begins with.
bool IsoScanner::scanBracket() {
  const char *const begin = at_;
  if (opensNamedVariable()) {
    scanNamedVariable();
  } else if (lexical_.conditionFirst && block_.words.empty() && block_.items.empty()) {
    Item item = itemAt(ItemKind::If, begin);
    item.condition = expression(MacroExpression::Form::Operand);
    add(item);
  } else if (startsBlock()) { // a line for another program, as a simulator
    at_ = lineEnd();
    issue(SyntaxIssueKind::BadStatement, begin, at_);
  } else {
    ++at_;
    issue(SyntaxIssueKind::UnbalancedBracket, begin, at_);
  }
  return true;
}

/// `/`, `/3`: with O-words only before everything else.
bool IsoScanner::scanSkip() {
  if (lexical_.flowWords && !startsBlock())
    return false;
  ++at_;
  int8_t level = 0;
  if (at_ < end_ && *at_ >= '1' && *at_ <= '9')
    level = int8_t(*at_++ - '0');
  if (block_.skip < 0)
    block_.skip = level;
  return true;
}

/// End-of-file mark of older systems, often with padding after it; false when the text goes on.
bool IsoScanner::scanEndOfFile() {
  const char *p = at_;
  while (p < end_ && (*p == '\x1A' || isLineBlank(*p) || isLineEnd(*p)))
    ++p;
  if (p < end_)
    return false;
  at_ = end_;
  return true;
}

/// What means nothing: a number without its address, a symbol in an address's place, other bytes.
void IsoScanner::scanStray() {
  const char *const begin = at_;
  if (numberFollows()) {
    // One issue for the whole of it, unless it is no number either.
    Word ignored;
    const size_t before = block_.issues.size();
    const bool any = scanNumber(ignored, begin);
    if (any && block_.issues.size() == before)
      issue(SyntaxIssueKind::MissingAddress, begin, at_);
    if (at_ == begin)
      ++at_;
    return;
  }
  if (uint8_t(*at_) < 128 && *at_ > 32 && at_ + 1 < end_ && isNumberDigit(at_[1])) {
    ++at_;
    while (at_ < end_ && (isNumberDigit(*at_) || *at_ == '.'))
      ++at_;
    issue(SyntaxIssueKind::SymbolAsAddress, begin, at_);
    return;
  }
  // A run of bytes is one issue.
  ++at_;
  while (at_ < end_ && (uint8_t(*at_) >= 128 || (*at_ == *begin && *at_ != '#')))
    ++at_;
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

IsoReader::IsoReader(const Dialect &dialect, llvm::StringRef text)
    : QuickReader(text), lexical_(dialect.lexical), symbols_(dialect) {}

std::string IsoReader::labelKey(llvm::StringRef label) const { return isoFlowLabel(label); }

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
  IsoScanner(lexical_, symbols_, text_, offset, block).scan();
  dropOversized(block);
  if (!block.issues.empty())
    collapseProse(block);
}

/// After the comment at `at`, which is closed and holds no other; `at`: it is none.
static const char *afterComment(const char *at, const char *end) {
  if (*at != '(')
    return at;
  const char *const mark = findAny(at + 1, end, '(', ')', '\n', '\r');
  return mark < end && *mark == ')' ? mark + 1 : at;
}

/// Whether a comment after the words of `block` may mean something: what it calls, or an end.
bool IsoReader::maySay(const Block &block) const {
  constexpr AddressMask codes = maskOf('G') | maskOf('M');
  return !lexical_.abortMark.empty() ||
         (lexical_.fileInComment && (codes & maskOf(block.words.back().address)));
}

bool IsoReader::isPattern(const Block &block) const {
  return isAlikePattern(block) && (block.comments.empty() || !maySay(block));
}

bool IsoReader::readAlike(uint32_t offset, AddressMask free, Block &block) const {
  // A reading that has failed leaves some words with the places of another block.
  assert(!block.words.empty() && block.comments.size() <= 1);
  constexpr AlikeGrammar grammar{true, true, true};
  return ncvet::readAlike<isLineBlank, grammar>(
      text_, offset, free, block, [&](const char *at) { return afterComment(at, text_.end()); });
}

EmptyLines IsoReader::emptyLines(uint32_t offset, uint32_t limit) const {
  if (!lexical_.abortMark.empty()) // comments that do something
    return {offset, 0};
  const char *const base = text_.begin(), *const end = base + limit;
  return passEmptyLines<isLineBlank>(base, offset, limit, [&](const char *at) {
    return *at == ';' ? findAny(at, end, '\n', '\r', '\n', '\r') : afterComment(at, end);
  });
}

} // namespace ncvet
