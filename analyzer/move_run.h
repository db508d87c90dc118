// Runs of plain moves at feed: the same path whatever tool, feed and speed they are made with.
#pragma once

#include "analyzer/plain_run.h"
#include "analyzer/run_store.h"

namespace ncvet {

/// Moves at feed that only go on as the move before, and that mean nothing to any rule (see
/// `Rule::sleeps`). Their path depends on where the tool stands, on modes, frames and compensation;
/// it can be taken over with another tool, feed or speed, and with other things done before.
struct MoveRun : RunPlace {
  AddressMask addresses = 0;         ///< of all its blocks, and of the one before
  MachineState entry;                ///< places where things were set are left out
  decltype(entry.position) position; ///< behind it
  Interval fedFrom;                  ///< behind it
  std::array<Interval, 2> cutArea{emptyInterval,
                                  emptyInterval}; ///< that it cuts, where that is kept

  /// Highest Z on the way, where it begins included; infinite when it is not known.
  double highest = -std::numeric_limits<double>::infinity();

  /// Whether it is the same path from here, where the block before was `plain`.
  bool begins(const Dialect &dialect, const MachineState &state, const PlainRun &plain) const;
  /// Whether the tool stays below the level from which it was fed down.
  bool staysBelow(const Interval &level) const {
    return level.isConstant() && highest < level.value();
  }
  /// Makes of the state in front of it the one behind it.
  void carry(MachineState &state) const;
};

/// Whether a move like the block before, `plain`, leaves facts and coordinate systems as they are.
inline bool isSettled(const PlainRun &plain, const MachineState &state) {
  return plain.addresses && plain.machineAxes == state.machineAxes && plain.may == state.factsMay &&
         plain.must == state.factsMust;
}

} // namespace ncvet
