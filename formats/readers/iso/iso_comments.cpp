// Comments of word-address blocks: `( )`, `;`, and those that stop the program.
#include "formats/readers/iso/iso_scanner.h"

#include <cstring>

namespace ncvet {

void IsoScanner::scanComment() {
  const char *const begin = at_;
  const char *const line = lineEnd();
  const auto *close = static_cast<const char *>(memchr(at_, ')', size_t(line - at_)));
  const auto *inner = static_cast<const char *>(memchr(at_ + 1, '(', size_t(line - at_ - 1)));
  if (!close) {
    issue(SyntaxIssueKind::UnclosedComment, begin, line);
    at_ = line;
  } else if (inner && inner < close) {
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
  const char *const line = lineEnd();
  unsigned depth = 0;
  const char *outer = nullptr;
  for (const char *p = begin; p < line && !outer; ++p) {
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
