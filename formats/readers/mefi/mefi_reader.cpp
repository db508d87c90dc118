// Reader of MEFI programs: a block runs from one `N` to the next, over any number of lines.
#include "formats/readers/mefi/mefi_reader.h"

#include "formats/readers/block_limit.h"
#include "formats/readers/mefi/mefi_scanner.h"

namespace ncvet {

namespace {

/// Quotation marks of a word processor: U+201C to U+201E in UTF-8, and the same in Windows-1250 and
/// 1252. No character of UTF-8 begins with these bytes.
constexpr llvm::StringLiteral typographicQuotes[] = {"\xE2\x80\x9C", "\xE2\x80\x9D", "\xE2\x80\x9E",
                                                     "\x93",         "\x94",         "\x84"};

} // namespace

void MefiScanner::scan() {
  block_.begin = offset(at_);
  if (startsBlock())
    scanNumberOfBlock();
  else
    leading_ = true;
  while (at_ < end_ && !startsBlock())
    scanItem();
  finish();
}

void MefiScanner::scanNumberOfBlock() {
  const char *const begin = at_++;
  const bool sign = at_ < end_ && (*at_ == '-' || *at_ == '+');
  int64_t number = -1; // a bare N is a block without a number
  if (sign) {
    ++at_;
    number = takeWhole();
  } else if (at_ < end_ && isNumberDigit(*at_)) {
    Word digits;
    number = 0;
    takeDigits(digits, number, maxNumberDigits);
  }
  const bool point = !sign && at_ < end_ && *at_ == '.';
  while (point && at_ < end_ && (isNumberDigit(*at_) || *at_ == '.'))
    ++at_;
  setNumber(begin, number);
  content_ = at_;
  if (sign || point)
    issue(SyntaxIssueKind::MalformedNumber, begin, at_);
}

void MefiScanner::scanItem() {
  const char c = *at_;
  if (isMefiGap(c)) {
    ++at_;
    return;
  }
  if (c == '"') {
    scanComment();
  } else if (isLetter(c)) {
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
void MefiScanner::scanComment() {
  const char *const begin = at_;
  at_ = lineEnd();
  block_.comments.push_back({offset(begin), offset(at_)});
}

/// What is neither a comment nor letters nor a number after its letter.
void MefiScanner::scanOther() {
  for (const llvm::StringRef quote : typographicQuotes)
    if (rest().startswith(quote)) {
      issue(SyntaxIssueKind::TypographicQuote, at_, at_ + quote.size());
      return scanComment();
    }
  const char *const begin = at_;
  if (*at_ == '(' || *at_ == ';') {
    // A comment of another control: what it holds is not code.
    const bool closes = *at_ == '(';
    while (!atLineEnd() && !(closes && *at_ == ')'))
      ++at_;
    if (at_ < end_ && *at_ == ')')
      ++at_;
    return issue(SyntaxIssueKind::ForeignComment, begin, at_);
  }
  skipNumberCharacters();
  if (at_ > begin)
    return issue(SyntaxIssueKind::MissingAddress, begin, at_);
  const auto opensOther = [](char c) {
    return isMefiGap(c) || isLetter(c) || isNumberDigit(c) ||
           llvm::StringRef("\"(;-+.").contains(c);
  };
  while (at_ < end_ && !opensOther(*at_))
    ++at_;
  issue(SyntaxIssueKind::InvalidCharacter, begin, at_);
}

void MefiScanner::finish() {
  block_.next = offset(at_);
  block_.end = content_ ? offset(content_) : block_.begin;
  if (!leading_)
    return; // a bare N is a block
  if (block_.isEmpty() && block_.issues.empty())
    block_.kind = BlockKind::Empty;
  else
    issue(SyntaxIssueKind::OutsideBlock, base_ + block_.begin, base_ + block_.end);
}

void MefiReader::read(uint32_t offset, Block &block) const {
  block.clear();
  MefiScanner(dialect_, text_, offset, block).scan();
  dropOversized(block);
}

} // namespace ncvet
