// What surrounds the cursor while a block is being written.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

struct CursorContext {
  uint32_t offset = 0; ///< of the cursor
  Block block;         ///< that holds it; empty on a new line
  bool inComment = false, inString = false;
  uint32_t typedBegin = 0; ///< of the letters and digits that end at the cursor
  llvm::StringRef typed;   ///< these
  llvm::StringRef before;  ///< the block before them, blanks at its end cut off

  /// A bracket that is open at the cursor.
  struct Bracket {
    uint32_t at = 0;            ///< where it begins
    char kind = '(';            ///< `(`, `[` or `<`
    unsigned argument = 0;      ///< separators in it before the cursor
    uint32_t argumentBegin = 0; ///< after the last of these
    llvm::StringRef name;       ///< before `(` and `[`; after `<`, up to its `:`
  };
  std::optional<Bracket> bracket; ///< the innermost one

  /// Whether a word of the block is the one that is being written.
  bool isTyped(const Word &word) const {
    return word.offset <= offset && offset <= block.endOf(word) && word.offset >= typedBegin;
  }
};

CursorContext cursorContext(Snapshot &snapshot, uint32_t offset);

} // namespace ncvet::lsp
