// Line numbers of offsets that follow one another.
#pragma once

#include "formats/text/line_index.h"

namespace ncvet {

/// Asks for lines from an offset to one after it: what is between the two is counted, not what is
/// between a counter of the index and the offset. Belongs to one thread.
class LineCursor {
public:
  /// As `LineIndex::lineOf`.
  uint32_t lineOf(const LineIndex &lines, uint32_t offset) {
    if (&lines == of_ && offset >= at_ && offset - at_ <= near)
      line_ += lines.countLineEnds(at_, offset);
    else
      line_ = lines.lineOf(offset);
    of_ = &lines;
    at_ = offset;
    return line_;
  }

private:
  static constexpr uint32_t near = 1u << 10; ///< bytes: half of what is counted for any offset

  const LineIndex *of_ = nullptr; ///< which lives as long as the cursor is asked
  uint32_t at_ = 0, line_ = 0;
};

} // namespace ncvet
