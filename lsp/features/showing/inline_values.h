// Variables of a text whose values the editor shows beside them while the program is debugged.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

struct InlineValue {
  SourceRange range;      ///< the variable, with the mark before its number or name
  std::string expression; ///< what the debugger is asked for: `#101`, `R1`
};

/// Those between `begin` and `end`, each line's variables once.
std::vector<InlineValue> inlineValues(Snapshot &snapshot, uint32_t begin, uint32_t end);

} // namespace ncvet::lsp
