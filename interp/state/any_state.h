// Whether a state is that after a program that nobody knows.
#pragma once

#include "interp/state/state.h"

#include "llvm/Support/MathExtras.h"

namespace ncvet {

/// Whether any cycle may be on, or none: more of them than paths which meet leave on.
inline bool anyCycleMayBeOn(const MachineState &state, const Dialect &dialect) {
  constexpr unsigned most = 4, motions = 4;
  return llvm::countPopulation(state.active(dialect, StandardGroup::Cycle)) > most ||
         llvm::countPopulation(state.active(dialect, StandardGroup::Motion)) > motions + most;
}

/// Whether any switch may be on: more of them than paths which meet leave on.
inline bool anySwitchMayBeOn(const MachineState &state) {
  constexpr unsigned most = 16;
  return llvm::countPopulation(state.switches.may) > most;
}

} // namespace ncvet
