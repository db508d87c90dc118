// The block that comes next in the text, where the run gives it without reading it twice.
#pragma once

#include "formats/readers/block.h"

namespace ncvet {

class TextAhead {
public:
  virtual ~TextAhead() = default;
  /// The block at `offset` when it is spelled as one that came after such a block as the current
  /// one: plain words alone. Null: it is not, or that is not known without reading it. Valid until
  /// the next block is executed.
  virtual const Block *peek(uint32_t offset) = 0;
};

} // namespace ncvet
