// New numbers for the blocks of a text, with all that names them.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

struct NumberOptions {
  int64_t first = 10, step = 10; ///< both above zero; they begin anew in every program
  /// Only blocks that begin in [begin, end) get other numbers. They lie between those around them:
  /// `first` does not count, and steps are smaller where there is no room.
  uint32_t begin = 0, end = 0xFFFFFFFF;
};

struct Renumbering {
  std::vector<TextEdit> edits;
  std::string refusal; ///< not empty: why nothing is changed, one sentence
  SourceRange at;      ///< the place that prevents it; empty: none
};

/// Numbers the numbered blocks of every program of the text anew; jumps, calls, profiles and
/// repeats that name one of them name it afterwards. Refused where a target is computed, or named
/// and not there: nobody knows then which block is meant.
Renumbering renumber(Snapshot &snapshot, const NumberOptions &options = {});

} // namespace ncvet::lsp
