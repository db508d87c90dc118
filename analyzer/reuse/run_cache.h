// What is known of the blocks of a file from an earlier analysis of almost the same text.
#pragma once

#include "analyzer/reuse/known_calls.h"
#include "analyzer/reuse/taken_runs.h"

namespace ncvet {

/// Text that was read only for the codes that end a program in it.
struct EndingRun : RunPlace {
  bool ends = false, returns = false;
};

/// Whether a reader finds nothing wrong in the block, whatever the state.
inline bool isClean(const Block &block, const Dialect &dialect) {
  return block.issues.empty() && !(block.addresses & ~dialect.known) &&
         !(block.repeated & ~dialect.repeatable);
}

/// The runs of one file, from one analysis to the next. Belongs to one thread.
class StraightRuns {
public:
  /// Every run that has seen the changed text is forgotten, those after it move.
  void edit(const TextChange &change);
  void clear() {
    straight.clear();
    for (RunStore<StraightRun> &level : chains)
      level.clear();
    stretches.clear();
    endings.clear();
    quiet.clear();
    calls.clear();
  }

  TakenRuns taken; ///< since that was last set to 0
  RunStore<StraightRun> straight;
  /// Of those above, or of the chains of the level below, that follow each other.
  std::array<RunStore<StraightRun>, 2> chains;
  /// Of blocks that only go on as the one before them, whatever is between these.
  RunStore<StraightRun> stretches;
  RunStore<EndingRun> endings;
  RunStore<RunPlace> quiet; ///< text in which a reader finds nothing wrong
  KnownCalls calls;
};

} // namespace ncvet
