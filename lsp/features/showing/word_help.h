// Help on the word at a place: what it is on this control, for hover.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet {
struct MachineState; // interp/state/state.h
}

namespace ncvet::lsp {

struct WordHelp {
  SourceRange range;    ///< of the word
  std::string markdown; ///< some lines
};

/// What is at byte `offset`: a code with its words, an address or parameter with its value, a
/// variable with what is known of it. `before` is the state on entry of its block; null: nothing is
/// known. None where nothing is to be told.
std::optional<WordHelp> wordHelp(Snapshot &snapshot, uint32_t offset,
                                 const MachineState *before = nullptr);

/// A code with its words, as hover and the documentation of a completion show it.
std::string codeHelp(const Dialect &dialect, const CodeInfo &code);
/// How a format names a word: `X or U`, `RTP`.
std::string specName(const Dialect &dialect, const WordSpec &spec);
/// What a word of a format is for, with its bounds: `peck depth, above 0 - required`.
std::string specHelp(const WordSpec &spec);

} // namespace ncvet::lsp
