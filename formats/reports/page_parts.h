// What a page holds of each program: its text with colours, and the path of its tool.
#pragma once

#include "formats/reports/report.h"

namespace ncvet {

/// Bytes of text that one page takes: what a browser still opens in seconds. Further texts, and the
/// rest of the last one, are left out, and the page says so.
constexpr size_t mostPageText = 64u << 20;

/// Moves of all paths in one page, for the same reason: what is left out is said as well.
constexpr size_t mostPageMoves = 3'000'000;

/// Writes the text of a file as an object of JSON: `text`, `colours`, `cut`. At most `budget`
/// bytes, of which what was used is taken.
void writeTextJson(const SourceFile &file, llvm::ArrayRef<TextColour> colours, size_t &budget,
                   llvm::raw_ostream &out);

/// Writes a path as docs/trace-format.md says.
void writeToolPathJson(const Report &report, const ToolPath &path, llvm::raw_ostream &out);

} // namespace ncvet
