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
  std::string title;               ///< empty: see `lensesToResolve`
  std::vector<SourceRange> places; ///< the callers
};

/// The lenses of a text from top to bottom; only those of the kinds that are on.
std::vector<CodeLens> codeLenses(Snapshot &snapshot,
                                 const std::array<bool, size_t(LensKind::Count)> &on = {true, true,
                                                                                        true});

/// The same without following the program: contours, over each block that may begin one, have no
/// title. `titleOfContour` gives it when the lens is looked at.
std::vector<CodeLens> lensesToResolve(Snapshot &snapshot);

/// "safe up to R6.00": what is known of the contour that begins in the block at `offset`.
std::string titleOfContour(Snapshot &snapshot, uint32_t offset);

} // namespace ncvet::lsp
