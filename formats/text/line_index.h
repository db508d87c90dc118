// Line numbers of byte offsets, in memory that does not grow with the number of lines.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <cstdint>
#include <vector>

namespace ncvet {

/// Counts lines of a text on demand: one counter every 64 KiB, the rest is counted when asked.
/// Line ends are LF, CR LF and a lone CR.
class LineIndex {
public:
  explicit LineIndex(llvm::StringRef text) : text_(text) {}

  /// Line (from 1) that holds byte `offset`.
  uint32_t lineOf(uint32_t offset) const;
  /// Offset of the first byte of the line that holds `offset`.
  uint32_t lineBegin(uint32_t offset) const;
  /// Offset behind the last byte of the line that holds `offset`, its line end not counted.
  uint32_t lineEnd(uint32_t offset) const;
  /// Offset of the first byte of line `line` (from 1); the text's size when there is no such line.
  uint32_t beginOfLine(uint32_t line) const;

private:
  void build() const;

  llvm::StringRef text_;
  mutable std::vector<uint32_t> counts_; ///< line ends in front of each 64 KiB step
};

} // namespace ncvet
