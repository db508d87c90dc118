// The parts of a document that an editor can fold.
#pragma once

#include "lsp/features/parts.h"

namespace ncvet::lsp {

struct Fold {
  /// From the first byte, whose line stays in view, to after the last byte of the last line that
  /// is hidden. More than one line.
  SourceRange range;
  PartKind kind = PartKind::Program;
};

/// By their begin, outer ones first.
std::vector<Fold> folds(Snapshot &snapshot);

} // namespace ncvet::lsp
