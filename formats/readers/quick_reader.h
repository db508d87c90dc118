// Readers that know short ways over blocks that are empty, or spelled as the one before.
#pragma once

#include "formats/readers/reader.h"

namespace ncvet {

/// Lines in which there is nothing but blanks and comments.
struct EmptyLines {
  uint32_t end = 0;   ///< where the first other line begins
  uint32_t count = 0; ///< how many they are
};

class QuickReader : public Reader {
public:
  /// Whether blocks of this text can be read over the block.
  virtual bool isPattern(const Block &block) const = 0;
  /// Reads the block at `offset` over the one that `block` holds, a pattern of this text, when it
  /// is spelled as that one save for its numbers: plain numbers, of the addresses `free` any, of
  /// the others the same, and of a comment at the end of its line. What it then gives is what
  /// `read` gives. False: it is not, or only `read` can tell. `block` then holds no block, but
  /// further ones can be read over it that are spelled as the one it held.
  virtual bool readAlike(uint32_t offset, AddressMask free, Block &block) const = 0;
  /// Goes from `offset`, where a block begins, over blocks in which there is nothing but blanks and
  /// comments with which nothing is wrong, at most to `limit`, a block's beginning or the end of
  /// the text. It may end before the last of them.
  virtual EmptyLines emptyLines(uint32_t offset, uint32_t limit) const = 0;
  /// False: no block of [begin, end) has a label.
  virtual bool mayHoldLabels(uint32_t /*begin*/, uint32_t /*end*/) const { return true; }

protected:
  using Reader::Reader;
};

} // namespace ncvet
