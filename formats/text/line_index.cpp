// Line numbers of byte offsets: sparse counters and short scans.
#include "formats/text/line_index.h"

#include <algorithm>
#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace ncvet {

bool LineIndex::endsLine(uint32_t offset) const {
  const char byte = text_[offset];
  if (byte == '\n')
    return true;
  return byte == '\r' && (offset + 1 >= size() || text_[offset + 1] != '\n');
}

namespace {

/// The line ends in [at, end), sixteen bytes at a time: `at` moves up to where fewer are left.
/// There is a byte at `end`.
uint32_t countWide([[maybe_unused]] const char *bytes, [[maybe_unused]] uint32_t &at,
                   [[maybe_unused]] uint32_t end) {
  uint32_t count = 0;
#if defined(__SSE2__)                              // part of every x86-64
  constexpr uint32_t wide = 16, most = 255 * wide; // a byte counts no further
  const __m128i feed = _mm_set1_epi8('\n'), carriage = _mm_set1_epi8('\r');
  const auto load = [&](uint32_t from) {
    return _mm_loadu_si128(reinterpret_cast<const __m128i *>(bytes + from));
  };
  while (end - at >= wide) {
    __m128i counts = _mm_setzero_si128();
    for (const uint32_t stop = at + std::min(most, end - at); stop - at >= wide; at += wide) {
      const __m128i here = load(at);
      const __m128i alone =
          _mm_andnot_si128(_mm_cmpeq_epi8(load(at + 1), feed), _mm_cmpeq_epi8(here, carriage));
      counts = _mm_sub_epi8(counts, _mm_or_si128(_mm_cmpeq_epi8(here, feed), alone));
    }
    const __m128i sums = _mm_sad_epu8(counts, _mm_setzero_si128());
    count +=
        uint32_t(_mm_cvtsi128_si32(sums)) + uint32_t(_mm_cvtsi128_si32(_mm_srli_si128(sums, 8)));
  }
#endif
  return count;
}

} // namespace

uint32_t LineIndex::countLineEnds(uint32_t begin, uint32_t end) const {
  end = std::min(end, size());
  if (begin >= end)
    return 0;
  // The last byte of the text has no neighbour and is looked at alone.
  const char *const bytes = text_.data();
  const uint32_t inner = std::min(end, size() - 1);
  uint32_t at = begin;
  uint32_t count = countWide(bytes, at, inner);
  for (; at < inner; ++at)
    count +=
        static_cast<uint32_t>(bytes[at] == '\n') |
        (static_cast<uint32_t>(bytes[at] == '\r') & static_cast<uint32_t>(bytes[at + 1] != '\n'));
  return count + (inner < end && endsLine(inner) ? 1 : 0);
}

LineIndex::LineIndex(llvm::StringRef text, const LineIndex &before, uint32_t begin, uint32_t end,
                     uint32_t added)
    : text_(text) {
  // Whether a line ends before an offset may depend on the byte there: it must be an old one.
  auto kept = std::lower_bound(before.counts_.begin(), before.counts_.end(), begin,
                               [](const Count &count, uint32_t o) { return count.offset < o; });
  kept = std::max(kept, before.counts_.begin() + 1);
  counts_.assign(before.counts_.begin(), kept);
  const auto moved =
      std::upper_bound(kept, before.counts_.end(), end,
                       [](uint32_t o, const Count &count) { return o < count.offset; });
  if (moved == before.counts_.end())
    return;
  const auto shifted = [&](uint32_t offset) { return offset - end + begin + added; };
  countUpTo(shifted(moved->offset));
  const uint32_t lines =
      counts_.back().lines + countLineEnds(counts_.back().offset, shifted(moved->offset));
  // Counters that have come close to one another serve nobody.
  auto first = moved;
  if (shifted(first->offset) - counts_.back().offset < step / 2 &&
      first + 1 != before.counts_.end())
    ++first;
  counts_.reserve(counts_.size() + size_t(before.counts_.end() - first));
  for (auto count = first; count != before.counts_.end(); ++count)
    counts_.push_back({shifted(count->offset), count->lines - moved->lines + lines});
}

void LineIndex::countUpTo(uint32_t offset) const {
  while (offset - std::min(offset, counts_.back().offset) >= step) {
    const Count &last = counts_.back();
    const uint32_t next = last.offset + step;
    counts_.push_back({next, last.lines + countLineEnds(last.offset, next)});
  }
}

const LineIndex::Count &LineIndex::countBefore(uint32_t offset) const {
  countUpTo(offset);
  const auto next =
      std::upper_bound(counts_.begin(), counts_.end(), offset,
                       [](uint32_t o, const Count &count) { return o < count.offset; });
  return *(next - 1);
}

uint32_t LineIndex::lineOf(uint32_t offset) const {
  offset = std::min(offset, size());
  const Count &count = countBefore(offset);
  return 1 + count.lines + countLineEnds(count.offset, offset);
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
  const uint32_t ends = line - 1; // the line begins after this many line ends
  while (counts_.back().lines < ends && size() - counts_.back().offset >= step)
    countUpTo(counts_.back().offset + step);
  // The last counter below `ends`: the line end looked for is after it.
  const auto found =
      std::lower_bound(counts_.begin(), counts_.end(), ends,
                       [](const Count &count, uint32_t n) { return count.lines < n; }) -
      1;
  uint32_t count = found->lines;
  for (uint32_t at = found->offset; at < size(); ++at)
    if (endsLine(at) && ++count == ends)
      return at + 1;
  return size();
}

} // namespace ncvet
