// The path of a tool as JSON: see docs/trace-format.md.
#pragma once

#include "formats/finding/tool_path.h"

#include "llvm/ADT/ArrayRef.h"

namespace ncvet {

/// A whole path. `files`: names of its files.
std::string toolPathText(const ToolPath &path, llvm::ArrayRef<std::string> files);

/// What an edit has made of a path that somebody has already. `byPlaces`: moves that only end
/// elsewhere may be told by their places alone.
std::string toolPathChangeText(const ToolPath &path, llvm::ArrayRef<std::string> files,
                               const ToolPathChange &change, bool byPlaces = false);

} // namespace ncvet
