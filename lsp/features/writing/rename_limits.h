// What may not be renamed, and why.
#pragma once

#include "lsp/features/names.h"
#include "lsp/features/snapshot.h"

namespace ncvet::lsp {

/// Why `one`, a name of the document, keeps its name; empty: it may get another one.
std::string whyNotRenamed(Snapshot &snapshot, const Occurrence &one);

/// Why a variable that programs of several files share keeps its name, as far as `unit`, one of
/// these files, tells it alone; empty: it does not. `one` is a place of it there.
std::string whyNotRenamedIn(FileUnit &unit, const Names &names, const Occurrence &one);

/// Why a name of this kind cannot be spelled so; empty: it can. What the reader makes of it in its
/// place is another question.
std::string whyNotSpelled(Snapshot &snapshot, const Occurrence &one, llvm::StringRef name);

} // namespace ncvet::lsp
