// Continuation moves: blocks that only go on as the block before.
#pragma once

#include "interp/execute/execute.h"
#include "interp/state/event.h"

namespace ncvet {

/// Detects continuation moves: same addresses, modes and facts; only coordinates differ.
struct PlainRun {
  AddressMask addresses = 0; ///< of the block before; 0: it was no plain move
  uint32_t machineAxes = 0;
  uint64_t may = 0, must = 0; ///< facts before it

  bool goesOn(const Block &block, const Outcome &outcome, const MachineState &before) {
    if (!outcome.plainMove) {
      addresses = 0;
      return false;
    }
    const bool same = addresses == block.addresses && machineAxes == before.machineAxes &&
                      may == before.factsMay && must == before.factsMust;
    addresses = block.addresses;
    machineAxes = before.machineAxes;
    may = before.factsMay;
    must = before.factsMust;
    return same;
  }
  friend bool operator==(const PlainRun &, const PlainRun &) = default;
};

} // namespace ncvet
