// Comments of word-address blocks: `( )`, `;`, and those that stop the program.
#include "formats/readers/iso/iso_scanner.h"

#include <algorithm>

namespace ncvet {

void IsoScanner::scanComment() {
  const char *const begin = at_;
  // No further than to its end: a line may hold thousands of them.
  const char *close = at_ + 1;
  const char *inner = nullptr;
  for (; close < end_ && *close != ')' && !isLineEnd(*close); ++close)
    if (*close == '(' && !inner)
      inner = close;
  if (close == end_ || *close != ')') {
    issue(SyntaxIssueKind::UnclosedComment, begin, close);
    at_ = close;
  } else if (inner) {
    scanNestedComment(begin, inner, close);
  } else {
    at_ = close + 1;
  }
  block_.comments.push_back({offset(begin), offset(at_)});
  if (lexical_.fileInComment)
    nameCallee(begin);
  if (!lexical_.abortMark.empty())
    scanAbort(begin);
}

/// The comment ends at the first `)` for the control; when the parentheses balance the writer meant
/// the outer one, and that is where reading goes on.
void IsoScanner::scanNestedComment(const char *begin, const char *inner, const char *close) {
  constexpr ptrdiff_t longest = 4096; // no line of a control has so many characters
  const char *const stop = std::min(end_, begin + std::min(longest, end_ - begin));
  unsigned depth = 0;
  const char *outer = nullptr;
  for (const char *p = begin; p < stop && !isLineEnd(*p) && !outer; ++p) {
    if (*p == '(')
      ++depth;
    else if (*p == ')' && --depth == 0)
      outer = p;
  }
  issue(SyntaxIssueKind::NestedComment, inner, close + 1);
  at_ = (outer ? outer : close) + 1;
}

/// `;` ends the block; what is after it is a comment.
void IsoScanner::scanLineComment() {
  const char *const begin = at_;
  const char *const line = lineEnd();
  if (afterBlanks(at_ + 1) < line)
    block_.comments.push_back({offset(begin), offset(line)});
  at_ = line;
}

/// `M98 (PART.NC)`: the comment right after a code that calls, where no P comes before it, names
/// the program.
void IsoScanner::nameCallee(const char *begin) {
  constexpr ptrdiff_t brackets = 2;
  if (block_.words.empty() || block_.has(letterAddress('P')) || at_ - begin <= brackets)
    return;
  const Word &last = block_.words.back();
  constexpr int64_t subprogram = 98, macro = 65;
  const bool calls = (last.address == letterAddress('M') && last.mantissa == subprogram) ||
                     (last.address == letterAddress('G') && last.mantissa == macro);
  if (!calls || afterBlanks(base_ + block_.endOf(last)) != begin)
    return;
  block_.nameBegin = offset(begin) + 1;
  block_.nameEnd = offset(at_) - 1;
}

/// A comment that stops the program.
void IsoScanner::scanAbort(const char *begin) {
  const llvm::StringRef text = llvm::StringRef(begin + 1, size_t(at_ - begin - 1)).ltrim();
  if (!text.startswith_insensitive(lexical_.abortMark))
    return;
  Item item = itemAt(ItemKind::Abort, begin);
  add(item);
}

} // namespace ncvet
