// Line numbers of byte offsets, in memory that does not grow with the number of lines.
#pragma once

#include "llvm/ADT/StringRef.h"

#include <cstdint>
#include <vector>

namespace ncvet {

/// Counts lines of a text on demand: one counter about every 4 KiB as far as was ever asked, the
/// rest is counted when asked, so that no question takes long, not even in a text that is one long
/// line. Line ends are LF, CR LF and a lone CR; a line end belongs to its line. Offsets after the
/// text count as its end. Not for several threads at a time, unless all is counted.
class LineIndex {
public:
  explicit LineIndex(llvm::StringRef text) : text_(text) {}
  /// The index of `text`, in which the bytes [begin, end) of the text of `before` have become
  /// `added` bytes: what was counted beside them is not counted again.
  LineIndex(llvm::StringRef text, const LineIndex &before, uint32_t begin, uint32_t end,
            uint32_t added);

  /// Line (from 1) that holds byte `offset`.
  uint32_t lineOf(uint32_t offset) const;
  /// Offset of the first byte of the line that holds `offset`.
  uint32_t lineBegin(uint32_t offset) const;
  /// Offset after the last byte of the line that holds `offset`, its line end not counted.
  uint32_t lineEnd(uint32_t offset) const;
  /// Offset of the first byte of line `line` (from 1); the text's size when there is no such line.
  uint32_t beginOfLine(uint32_t line) const;

  /// Number of line ends that end within [begin, end).
  uint32_t countLineEnds(uint32_t begin, uint32_t end) const;

  /// Lines are counted up to this offset.
  uint32_t counted() const { return counts_.back().offset; }
  void countAll() const { lineOf(size()); }

private:
  static constexpr uint32_t step = 1u << 12;
  /// Line ends before an offset.
  struct Count {
    uint32_t offset = 0, lines = 0;
  };

  uint32_t size() const { return static_cast<uint32_t>(text_.size()); }
  /// True when a line ends with the byte at `offset`: LF, or CR without LF after it.
  bool endsLine(uint32_t offset) const;
  /// Counts on, step by step, while `offset` lies further off than one.
  void countUpTo(uint32_t offset) const;
  /// The last counter before `offset` or at it, up to which lines are counted.
  const Count &countBefore(uint32_t offset) const;

  llvm::StringRef text_;
  mutable std::vector<Count> counts_ = {Count()}; ///< by offset
};

} // namespace ncvet
