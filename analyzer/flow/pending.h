// Where states wait for each other, and how they are joined.
#pragma once

#include "analyzer/flow/region.h"

#include <map>
#include <memory>

namespace ncvet {

/// Adds a state to those at one place: equal ones become one, and of too many the closest are
/// joined.
void mergeInto(Lives &lives, Live live);

/// The states of one region that wait at blocks until all paths that lead there have arrived.
class Pending {
public:
  bool isEmpty() const { return next_ == ~0u; }
  /// Offset of the first block at which states wait; `~0u`: there is none.
  uint32_t next() const { return next_; }
  void wait(uint32_t offset, Live live);
  /// As `wait`, but for states that bring nothing new. Blocks before `executed` were executed.
  void add(uint32_t offset, Live live, uint32_t executed);
  /// The states at the first block; `offset` becomes its offset.
  Lives take(uint32_t &offset);
  /// Joined states go back over a backward jump.
  void startRound() { ++rounds_; }
  bool hasRounds() const { return rounds_ != 0; }

private:
  /// What is remembered of a block at which paths arrive again and again.
  struct Meeting {
    unsigned lastRound = 0;
    unsigned rounds = 0;                ///< in so many rounds a path arrived
    std::unique_ptr<MachineState> seen; ///< all that has gone on from here, since it is kept
  };
  bool bringsNothing(uint32_t offset, HeldState &state, uint32_t executed);

  uint32_t next_ = ~0u;
  Lives first_;                     ///< that wait at `next_`
  std::map<uint32_t, Lives> later_; ///< that wait after it
  unsigned rounds_ = 0;             ///< times that joined states went back over a backward jump
  std::map<uint32_t, Meeting> meetings_;
};

} // namespace ncvet
