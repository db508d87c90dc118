// Runs of plain blocks that an earlier analysis of almost the same text has followed.
#pragma once

#include "analyzer/move_run.h"
#include "analyzer/rule_memory.h"

namespace ncvet {

/// A run of blocks that are executed one after the other, of which no rule had anything to say.
/// Where it begins again in the same text, in the same state and with rules that remember the same,
/// it ends as it did.
struct StraightRun : RunPlace {
  uint32_t from = 0, to = 0; ///< the text that was looked at for it
  bool isClean = true;       ///< a reader finds nothing wrong in it
  MachineState entry, exit;
  PlainRun plainEntry, plainExit;
  RuleMemory memory; ///< at its begin, and at its end as well

  explicit StraightRun(FileId file) : memory(file) {}
};

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
  /// Blocks of a run: enough that a text has few of them, so few that an edit costs little.
  static constexpr unsigned longest = 512;
  static constexpr unsigned shortest = 16;

  /// Every run that has seen the changed text is forgotten, those behind it move.
  void edit(const TextChange &change);
  void clear() {
    straight.clear();
    moves.clear();
    endings.clear();
    quiet.clear();
  }

  RunStore<StraightRun> straight;
  RunStore<MoveRun> moves;
  RunStore<EndingRun> endings;
  RunStore<RunPlace> quiet; ///< text in which a reader finds nothing wrong
};

} // namespace ncvet
