// Formatting: blanks between words. What a block means never changes.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

enum class WordSpacing : uint8_t {
  Keep, ///< as they are
  One,  ///< one blank between two words
  None  ///< no blank
};

struct FormatOptions {
  WordSpacing words = WordSpacing::One;
  bool trim = true; ///< no blanks at the ends of lines
};

/// The edits that format the blocks that touch [begin, end): at most one for the words of a block
/// and one for the end of each of its lines, ascending. Comments and strings stay as they are, and
/// so do blocks that could not be read without a fault, and blocks that would read otherwise.
std::vector<TextEdit> formatEdits(Snapshot &snapshot, uint32_t begin, uint32_t end,
                                  const FormatOptions &options = {});

} // namespace ncvet::lsp
