// Comments that silence a rule, in the document's own form of comment.
#pragma once

#include "formats/text/edit.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// A line before the block at `offset` that allows `rule` there; none when the control has no
/// form of comment for a line of its own.
std::optional<TextEdit> allowHere(Snapshot &snapshot, uint32_t offset, llvm::StringRef rule);
/// A line that allows `rule` in the whole file, after the head of its first program.
std::optional<TextEdit> allowInFile(Snapshot &snapshot, llvm::StringRef rule);

} // namespace ncvet::lsp
