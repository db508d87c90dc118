// Code lenses: lines over programs, contours and tools that say what is known of them.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

enum class LensKind : uint8_t {
  Callers, ///< over a program or subprogram: its calls, in this file and the files round it
  Contour, ///< over the block that begins compensation: up to which radius the contour stays whole
  Tool,    ///< over a tool change: the tool, and the blocks up to the next one
  Count
};

struct CodeLens {
  SourceRange range; ///< of what it is shown above
  LensKind kind = LensKind::Callers;
  std::string title;
  std::vector<SourceRange> places; ///< the callers
};

/// The lenses of a text from top to bottom; only those of the kinds that are on.
std::vector<CodeLens> codeLenses(Snapshot &snapshot,
                                 const std::array<bool, size_t(LensKind::Count)> &on = {true, true,
                                                                                        true});

} // namespace ncvet::lsp
