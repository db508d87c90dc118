// The most that one block holds.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

/// Words, items, comments and issues of one block, each at most: controls take lines of some
/// hundred characters. What looks at each of them together with each other takes a time that grows
/// with the square of their number.
constexpr size_t mostPartsOfBlock = 4096;

/// A block of more parts is none: nothing of it is kept but an issue that says so.
inline void dropOversized(Block &block) {
  if (block.words.size() <= mostPartsOfBlock && block.items.size() <= mostPartsOfBlock &&
      block.comments.size() <= mostPartsOfBlock && block.issues.size() <= mostPartsOfBlock)
    return;
  const uint32_t begin = block.begin, end = block.end, next = block.next;
  block.clear();
  block.begin = begin;
  block.end = end;
  block.next = next;
  block.issues.push_back({SyntaxIssueKind::NotABlock, begin, end});
}

} // namespace ncvet
