// Continuation moves: blocks that only go on as the block before.
#pragma once

#include "interp/execute/execute.h"
#include "interp/state/event.h"

namespace ncvet {

/// Detects continuation moves: same addresses, codes, modes and facts; only coordinates differ.
struct PlainRun {
  AddressMask addresses = 0; ///< of the block before; 0: it was no plain move
  uint64_t codes = 0;        ///< hash of the codes that it named, all in force already; 0: none
  /// Rules that are told of changes only have nothing to say of another block like it, though it
  /// names codes.
  bool settled = false;
  uint32_t machineAxes = 0;
  uint64_t may = 0, must = 0; ///< facts before it

  bool goesOn(const Block &block, const Outcome &outcome, const MachineState &before) {
    if (!outcome.plainMove) {
      if (addresses)
        *this = {};
      return false;
    }
    const uint64_t named = hashOf(outcome);
    const bool same = addresses == block.addresses && codes == named && repeats(before);
    settled &= same;
    addresses = block.addresses;
    codes = named;
    machineAxes = before.machineAxes;
    may = before.factsMay;
    must = before.factsMust;
    return same;
  }
  /// Whether a block that is spelled as the one before goes on from here.
  bool repeats(const MachineState &before) const {
    return machineAxes == before.machineAxes && may == before.factsMay && must == before.factsMust;
  }
  static uint64_t hashOf(const Outcome &outcome) {
    uint64_t hash = 0;
    for (const CodeUse &use : outcome.codes)
      hash = hash * 1000003 + use.code + 1;
    return hash;
  }
  friend bool operator==(const PlainRun &, const PlainRun &) = default;
};

} // namespace ncvet
