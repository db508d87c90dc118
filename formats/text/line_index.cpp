// Line numbers of byte offsets: sparse counters and short scans.
#include "formats/text/line_index.h"

#include <algorithm>

namespace ncvet {

bool LineIndex::endsLine(uint32_t offset) const {
  const char byte = text_[offset];
  if (byte == '\n')
    return true;
  return byte == '\r' && (offset + 1 >= size() || text_[offset + 1] != '\n');
}

uint32_t LineIndex::countLineEnds(uint32_t begin, uint32_t end) const {
  end = std::min(end, size());
  if (begin >= end)
    return 0;
  // No branch per byte, so that the compiler counts many bytes at once; the last byte of the text
  // has no neighbour and is looked at alone.
  const char *bytes = text_.data();
  const uint32_t inner = std::min(end, size() - 1);
  uint32_t count = 0;
  for (uint32_t at = begin; at < inner; ++at)
    count +=
        static_cast<uint32_t>(bytes[at] == '\n') |
        (static_cast<uint32_t>(bytes[at] == '\r') & static_cast<uint32_t>(bytes[at + 1] != '\n'));
  return count + (inner < end && endsLine(inner) ? 1 : 0);
}

void LineIndex::countUpTo(uint32_t last) const {
  while (counts_.size() <= last) {
    const auto begin = static_cast<uint32_t>(counts_.size() - 1) * step;
    counts_.push_back(counts_.back() + countLineEnds(begin, begin + step));
  }
}

uint32_t LineIndex::lineOf(uint32_t offset) const {
  offset = std::min(offset, size());
  const uint32_t block = offset / step;
  countUpTo(block);
  return 1 + counts_[block] + countLineEnds(block * step, offset);
}

uint32_t LineIndex::lineBegin(uint32_t offset) const {
  offset = std::min(offset, size());
  const uint32_t near = offset - std::min(offset, step);
  for (uint32_t begin = offset; begin > near; --begin)
    if (endsLine(begin - 1))
      return begin;
  return near == 0 ? 0 : beginOfLine(lineOf(offset));
}

uint32_t LineIndex::lineEnd(uint32_t offset) const {
  offset = std::min(offset, size());
  if (offset > 0 && offset < size() && text_[offset] == '\n' && text_[offset - 1] == '\r')
    return offset - 1;
  const uint32_t near = offset + std::min(size() - offset, step);
  for (uint32_t end = offset; end < near; ++end)
    if (text_[end] == '\n' || text_[end] == '\r')
      return end;
  if (near == size())
    return near;
  const uint32_t next = beginOfLine(lineOf(offset) + 1);
  if (!endsLine(next - 1)) // the last line, without a line end
    return next;
  return next - (text_[next - 1] == '\n' && text_[next - 2] == '\r' ? 2 : 1);
}

uint32_t LineIndex::beginOfLine(uint32_t line) const {
  if (line <= 1)
    return 0;
  const uint32_t ends = line - 1; // the line begins behind this many line ends
  const uint32_t lastBlock = size() / step;
  while (counts_.back() < ends && counts_.size() <= lastBlock)
    countUpTo(static_cast<uint32_t>(counts_.size()));
  // The last counter below `ends`: the line end looked for lies in its block.
  const auto found = std::lower_bound(counts_.begin(), counts_.end(), ends) - 1;
  uint32_t count = *found;
  for (auto at = static_cast<uint32_t>(found - counts_.begin()) * step; at < size(); ++at)
    if (endsLine(at) && ++count == ends)
      return at + 1;
  return size();
}

} // namespace ncvet
