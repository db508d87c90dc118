// Visits the places of one byte in a text, sixteen bytes at a time.
#pragma once

#include <bit>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace ncvet {

/// Calls `visit(place)` for each place of [at, end) that holds the byte, in their order. Reads
/// nothing outside of the range.
template <typename Visit>
void eachByte(const char *at, const char *end, char wanted, Visit visit) {
#if defined(__SSE2__) // part of every x86-64
  constexpr int wide = 16;
  const __m128i wideWanted = _mm_set1_epi8(wanted);
  for (; end - at >= wide; at += wide) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i *>(at));
    auto found = uint32_t(_mm_movemask_epi8(_mm_cmpeq_epi8(bytes, wideWanted)));
    for (; found; found &= found - 1)
      visit(at + std::countr_zero(found));
  }
#endif
  for (; at < end; ++at)
    if (*at == wanted)
      visit(at);
}

} // namespace ncvet
