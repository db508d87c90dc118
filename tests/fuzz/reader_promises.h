// What every reader promises of a block, for the fuzz targets of the readers.
#pragma once

#include "formats/readers/select/make_reader.h"
#include "tests/fuzz/require.h"

#include <cstdint>

namespace ncvet::fuzz {

inline bool sameWord(const Word &a, const Word &b) {
  return a.address == b.address && a.flags == b.flags && a.decimals == b.decimals &&
         a.length == b.length && a.offset == b.offset && a.mantissa == b.mantissa;
}

/// What later layers see of a block.
inline bool sameBlock(const Block &a, const Block &b) {
  if (a.kind != b.kind || a.begin != b.begin || a.end != b.end || a.next != b.next ||
      a.skip != b.skip || a.number != b.number || a.program != b.program ||
      a.addresses != b.addresses || a.words.size() != b.words.size() ||
      a.items.size() != b.items.size() || a.expressions.size() != b.expressions.size() ||
      a.operations.size() != b.operations.size() || a.comments.size() != b.comments.size() ||
      a.issues.size() != b.issues.size())
    return false;
  for (size_t i = 0; i < a.words.size(); ++i)
    if (!sameWord(a.words[i], b.words[i]))
      return false;
  for (size_t i = 0; i < a.issues.size(); ++i)
    if (a.issues[i].kind != b.issues[i].kind || a.issues[i].begin != b.issues[i].begin ||
        a.issues[i].end != b.issues[i].end)
      return false;
  return true;
}

/// Everything that a block points at lies inside it, and all of its indices inside its vectors.
inline void requireConsistent(const Block &block, size_t size) {
  require(block.begin <= block.end && block.end <= block.next && block.next <= size);
  for (const Word &word : block.words) {
    require(word.offset >= block.begin && word.offset <= block.end);
    require(block.endOf(word) <= block.end);
    require(block.addresses & maskOf(word.address));
    if (word.has(wordExpression))
      require(static_cast<uint64_t>(word.mantissa) < block.expressions.size());
  }
  for (const Item &item : block.items)
    for (const uint16_t expression : {item.target, item.value, item.condition})
      require(expression == noExpression || expression < block.expressions.size());
  for (const Expression &expression : block.expressions)
    require(expression.first + expression.count <= block.operations.size());
  for (const Comment &comment : block.comments)
    require(comment.begin < comment.end && comment.end <= block.next);
  for (const SyntaxIssue &issue : block.issues)
    require(issue.begin <= issue.end && issue.end <= block.next);
}

/// Reads all of `text` from block to block; each block is also read by itself.
inline void readAll(const Dialect &dialect, llvm::StringRef text) {
  const std::unique_ptr<Reader> reader = makeReader(dialect, text);
  Block block;
  for (uint32_t offset = reader->first(); offset < text.size(); offset = block.next) {
    reader->read(offset, block);
    require(block.next > offset);
    requireConsistent(block, text.size());
    // A fresh block read from the same place: nothing is left of the blocks before.
    Block fresh;
    reader->read(offset, fresh);
    require(sameBlock(block, fresh));
  }
}

} // namespace ncvet::fuzz
