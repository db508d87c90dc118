// Places that are spelled alike because they belong together, and change together while one of them
// is typed.
#pragma once

#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// The places that change with the one at the byte `offset`, itself included, in the order of the
/// text: the numbers of a loop (`DO1`, `END1`), and the label of brackets and of a subprogram
/// between them. Empty where nothing belongs together, or where a place that does is not seen.
std::vector<SourceRange> linkedPlaces(Snapshot &snapshot, uint32_t offset);

} // namespace ncvet::lsp
