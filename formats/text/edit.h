// Edits of a text: what a fix changes, and how a set of them is applied.
#pragma once

#include "formats/text/source.h"

#include "llvm/ADT/ArrayRef.h"

#include <string>
#include <vector>

namespace ncvet {

/// Replaces the bytes of `range` by `text`; an empty range inserts.
struct TextEdit {
  SourceRange range;
  std::string text;
};

/// Applies edits to `text`; they must not overlap (asserted), their order does not matter.
std::string applyEdits(llvm::StringRef text, llvm::ArrayRef<TextEdit> edits);

/// True when two edits of one file touch the same bytes or insert at the same place.
bool overlaps(const TextEdit &a, const TextEdit &b);

} // namespace ncvet
