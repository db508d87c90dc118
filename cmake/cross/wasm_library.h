// What emscripten's C++ library lacks of C++20, for all sources that are compiled for it.
#pragma once

// Sizes have 32 bits there. What is counted in 64 bits elsewhere is of texts, which are shorter.
#pragma clang diagnostic ignored "-Wshorten-64-to-32"

#include <bit>
#include <unordered_map>

namespace std {
/// Of the library's version 14, one later than emscripten has.
template <class To, class From>
constexpr To bit_cast(const From &from) noexcept {
  return __builtin_bit_cast(To, from);
}
} // namespace std
