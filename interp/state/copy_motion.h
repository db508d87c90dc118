// Copies what changes with nearly every block.
#pragma once

#include "interp/state/state.h"

#include <cstring>
#include <utility>

namespace ncvet {

/// As an assignment, of which compilers make an instruction that takes longer to begin than all of
/// this does: it is done for every block.
inline void copyMotion(MotionState &to, const MotionState &from) {
  static_assert(std::is_trivially_copyable_v<MotionState>);
  constexpr size_t piece = 32, whole = sizeof(MotionState) / piece;
  auto *const target = reinterpret_cast<char *>(&to);
  const auto *const source = reinterpret_cast<const char *>(&from);
  [&]<size_t... i>(std::index_sequence<i...>) {
    (std::memcpy(target + i * piece, source + i * piece, piece), ...);
  }
  (std::make_index_sequence<whole>());
  std::memcpy(target + whole * piece, source + whole * piece, sizeof(MotionState) - whole * piece);
}

} // namespace ncvet
