// Finds the first of a few bytes, sixteen at a time.
#pragma once

#include <bit>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace ncvet {

/// The first byte of [at, end) that is one of the four, or `end`, one byte after the other.
inline const char *findAnyBytewise(const char *at, const char *end, char a, char b, char c,
                                   char d) {
  while (at < end && *at != a && *at != b && *at != c && *at != d)
    ++at;
  return at;
}

/// The same; reads nothing outside of the range.
inline const char *findAny(const char *at, const char *end, char a, char b, char c, char d) {
#if defined(__SSE2__) // part of every x86-64
  const __m128i wanted[] = {_mm_set1_epi8(a), _mm_set1_epi8(b), _mm_set1_epi8(c), _mm_set1_epi8(d)};
  constexpr int wide = 16;
  for (; end - at >= wide; at += wide) {
    const __m128i bytes = _mm_loadu_si128(reinterpret_cast<const __m128i *>(at));
    const __m128i found = _mm_or_si128(
        _mm_or_si128(_mm_cmpeq_epi8(bytes, wanted[0]), _mm_cmpeq_epi8(bytes, wanted[1])),
        _mm_or_si128(_mm_cmpeq_epi8(bytes, wanted[2]), _mm_cmpeq_epi8(bytes, wanted[3])));
    if (const auto mask = uint32_t(_mm_movemask_epi8(found)))
      return at + std::countr_zero(mask);
  }
#endif
  return findAnyBytewise(at, end, a, b, c, d);
}

} // namespace ncvet
