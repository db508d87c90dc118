// Reads which files of a folder call which programs.
#pragma once

#include "analyzer/program/folder_calls.h"
#include "formats/text/source_set.h"

namespace ncvet {

/// Calls of the programs of a folder: the files that end as `dialect` has it, or in `ending`.
FolderCalls readCalls(const std::string &folder, llvm::StringRef ending, const Dialect &dialect);
/// Those of one file.
FileCalls readCallsOf(const SourceFile &file, const Dialect &dialect);

} // namespace ncvet
