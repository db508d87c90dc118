// Where in the text a block is being read, and the block: what scanners and parsers use.
#pragma once

#include "formats/readers/block.h"

#include "llvm/ADT/StringRef.h"

namespace ncvet {

constexpr bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

/// A place in the text and the block that grows. Readers and parsers derive from it; a copy reads
/// on from the same place into the same block.
class BlockCursor {
public:
  BlockCursor(llvm::StringRef text, uint32_t offset, Block &block)
      : base_(text.begin()), at_(text.begin() + offset), end_(text.end()), block_(block) {}
  // Member by member: copied as a whole, the place just written would be waited for.
  BlockCursor(const BlockCursor &from)
      : base_(from.base_), at_(from.at_), end_(from.end_), block_(from.block_) {}

  const char *position() const { return at_; }

protected:
  uint32_t offset(const char *p) const { return uint32_t(p - base_); }
  void issue(SyntaxIssueKind kind, const char *begin, const char *end) {
    block_.issues.push_back({kind, offset(begin), offset(end)});
  }

  const char *const base_;
  const char *at_;
  const char *const end_;
  Block &block_;
};

} // namespace ncvet
