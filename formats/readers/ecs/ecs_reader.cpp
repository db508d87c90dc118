// Reader of ECS programs: blocks, what is before their words, comments.
#include "formats/readers/ecs/ecs_reader.h"

#include "formats/readers/block_limit.h"
#include "formats/readers/ecs/ecs_scanner.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {

void EcsScanner::scan() {
  block_.begin = offset(at_);
  const char *content = at_;
  while (at_ < end_ && !isLineEnd(*at_)) {
    if (isLineBlank(*at_)) {
      ++at_;
      continue;
    }
    if (beginsNextBlock()) {
      block_.end = offset(content);
      block_.next = offset(at_);
      return;
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

/// Whether the places of a code's arguments say what they are.
bool EcsScanner::takesPlaces(CodeIndex code) const {
  return code != noCode &&
         llvm::any_of(dialect_.codes[code].words, [](const WordSpec &w) { return w.position; });
}

/// `<MAT:..> <TCT:ON;..>`: a line of instructions runs them one after the other, each with
/// arguments of its own. The second one is read as a block of its own.
bool EcsScanner::beginsNextBlock() {
  if (*at_ != '<' || !block_.has(keywordAddress) ||
      (block_.addresses & ~(maskOf(keywordAddress) | maskOf(argumentAddress))) ||
      llvm::any_of(block_.items, [](const Item &i) { return i.kind != ItemKind::Instruction; }) ||
      llvm::none_of(block_.words, [&](const Word &w) {
        return w.address == keywordAddress && takesPlaces(CodeIndex(w.mantissa));
      }))
    return false;
  const char *const begin = at_++;
  skipBlanks();
  const std::string key = name().upper();
  at_ = afterBlanks(at_ + key.size());
  bool begins = false;
  if (!key.empty() && at_ < end_ && *at_ == ':') {
    ++at_;
    skipBlanks();
    const CodeIndex code = dialect_.keyword(key + ":" + name().upper());
    begins = takesPlaces(code != noCode ? code : dialect_.keyword(key));
  }
  at_ = begin;
  return begins;
}

void EcsScanner::scanItem() {
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
void EcsScanner::scanLineComment(unsigned mark) {
  const char *const begin = at_;
  if (mark > 1)
    issue(SyntaxIssueKind::TypographicQuote, begin, begin + mark);
  at_ = lineEnd();
  block_.comments.push_back({offset(begin), offset(at_)});
}

void EcsScanner::scanComment(char close) {
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

void EcsScanner::scanLabel() {
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
void EcsScanner::scanReset() {
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
void EcsScanner::scanPhase() {
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

void EcsScanner::scanOther() {
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

EcsReader::EcsReader(const Dialect &dialect, llvm::StringRef text)
    : Reader(text), dialect_(dialect) {
  for (size_t i = 0; i < dialect.addressNames.size(); ++i)
    addresses_[llvm::StringRef(dialect.addressNames[i]).upper()] = AddressId(firstNamed + i);
}

void EcsReader::read(uint32_t offset, Block &block) const {
  block.clear();
  EcsScanner(dialect_, addresses_, text_, offset, block).scan();
  dropOversized(block);
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
