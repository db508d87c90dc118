// The begin of a program: the tape mark `%`, and its header `O1234`.
#include "formats/readers/iso/iso_scanner.h"

namespace ncvet {

/// `%`, perhaps with the header on the same line.
void IsoScanner::scanTape() {
  const char *const begin = at_++;
  block_.kind = BlockKind::Tape;
  const char *const after = afterBlanks(at_);
  if (lexical_.percentHeader && after < end_ &&
      (*after == 'O' || *after == 'o' || *after == ':' || isNumberDigit(*after))) {
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
void IsoScanner::scanHeader(const char *begin) {
  block_.kind = BlockKind::ProgramHeader;
  block_.headerBegin = offset(begin);
  if (!isNumberDigit(*at_))
    ++at_;
  skipBlanks();
  int64_t number = 0;
  unsigned digits = 0;
  while (at_ < end_ && isNumberDigit(*at_)) {
    if (digits++ < 9)
      number = number * 10 + (*at_ - '0');
    ++at_;
  }
  block_.program = digits && digits <= 9 ? number : -1;
  if (lexical_.percentHeader)
    while (!atLineEnd() && !isLineBlank(*at_) && *at_ != '(')
      ++at_;
  block_.headerEnd = offset(at_);
}

/// `<NAME>` at `mark`: the header of a program, or the name that a call before it gives; false,
/// with nothing read: none is there.
bool IsoScanner::scanName(const char *begin, const char *mark) {
  if (!lexical_.namedPrograms)
    return false;
  const char *const name = mark + 1;
  const char *close = name;
  while (close < end_ && !isLineEnd(*close) && *close != '>')
    ++close;
  if (close >= end_ || *close != '>' || !(isLetter(*name) || isNumberDigit(*name)))
    return false;
  at_ = close + 1;
  block_.nameBegin = offset(name);
  block_.nameEnd = offset(close);
  if (startsBlock()) {
    block_.kind = BlockKind::ProgramHeader;
    block_.headerBegin = offset(begin);
    block_.headerEnd = offset(at_);
    block_.program = -1;
  }
  return true;
}

} // namespace ncvet
