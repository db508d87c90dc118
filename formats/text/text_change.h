// A change of a text: which bytes became which.
#pragma once

#include "formats/text/source.h"

namespace ncvet {

/// The bytes [begin, end) of a text became `added` bytes.
struct TextChange {
  uint32_t begin = 0, end = 0, added = 0;

  uint32_t endAfter() const { return begin + added; }
  /// Whether a range lies wholly in front of the change or behind it.
  bool spares(uint32_t from, uint32_t to) const { return to <= begin || from >= end; }
  /// Where a place that is not inside the change lies behind it.
  uint32_t moved(uint32_t offset) const {
    return offset >= end ? offset - end + endAfter() : offset;
  }
};

/// The one change that leads from a text to another: what lies between the bytes that they have in
/// common at their begin and at their end.
TextChange changeBetween(llvm::StringRef before, llvm::StringRef after);

} // namespace ncvet
