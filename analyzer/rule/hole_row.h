// Holes of a row that are told together.
#pragma once

#include "interp/state/event.h"

namespace ncvet {

/// Holes one after the other of one cycle in force, each in a block of nothing but its place in
/// known numbers, and each followed by another such block.
struct HoleRow {
  static constexpr size_t mostAxes = 3;
  struct Hole {
    uint32_t begin, end, next;       ///< of its block
    uint8_t kind;                    ///< index in `kinds`
    std::array<double, mostAxes> at; ///< by `axes`
  };
  llvm::SmallVector<Axis, mostAxes> axes;      ///< along which they lie apart; not that of the tool
  llvm::SmallVector<const Outcome *, 4> kinds; ///< what their blocks do, but for the places
  std::vector<Hole> holes;
};

} // namespace ncvet
