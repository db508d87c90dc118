// Records runs of plain blocks while a program is followed, and finds those that are known already.
#pragma once

#include "analyzer/collector.h"
#include "analyzer/dispatch.h"
#include "analyzer/straight_runs.h"

namespace ncvet {

/// At work while the first program of a file is followed straight on. Without a store it does
/// nothing.
class RunRecorder {
public:
  RunRecorder(StraightRuns *runs, FileUnit &unit, const Dispatcher &dispatcher,
              const Collector &collector);

  bool isOn() const { return runs_; }
  /// In front of the block at `offset`, which one state alone reaches: the run that can be taken
  /// over from here, or null.
  const StraightRun *at(uint32_t offset, const MachineState &state, const PlainRun &plain);
  /// The same for a run of moves, where no other run can be taken over.
  const MoveRun *movesAt(uint32_t offset, const MachineState &state, const PlainRun &plain);
  /// A run of moves was taken over.
  void took(const MoveRun &run);
  /// A block was executed, and the next one follows. `goesOn`: it only goes on as the one before.
  void executed(const Block &block, bool goesOn, const MachineState &before,
                const MachineState &after) {
    if (runs_)
      take(block, goesOn, before, after);
  }
  /// What is being recorded is no run. Returns null.
  const StraightRun *interrupt() {
    if (recording_)
      keep();
    if (moves_)
      keepMoves();
    return nullptr;
  }

private:
  void take(const Block &block, bool goesOn, const MachineState &before, const MachineState &after);
  void takeBlock(const Block &block);
  bool mark(uint32_t end, const MachineState &state, const PlainRun &plain);
  void keep();
  void begin(uint32_t offset, const MachineState &state, const PlainRun &plain);
  const StraightRun *joined(const StraightRun &run);
  const MoveRun *joined(const MoveRun &run);
  bool goesOnAs(const StraightRun &run, const MachineState &state, const PlainRun &plain);
  void beginMoves(uint32_t offset, const MachineState &state, const PlainRun &plain);
  void takeMove(const Block &block, const MachineState &after);
  void markMoves(uint32_t end, const MachineState &state);
  void endMoves(uint32_t end, const MachineState &state);
  void keepMoves();

  StraightRuns *runs_;
  FileUnit &unit_;
  const Dispatcher &dispatcher_;
  const Collector &collector_;
  /// Its end is the last place up to which it is known to be a run; 0: there is none yet.
  std::optional<StraightRun> recording_;
  uint64_t blocks_ = 0; ///< executed since its begin, with content
  bool clean_ = true;   ///< all of them
  uint32_t lastBegin_ = 0, lastEnd_ = 0;
  uint32_t nextKnown_ = ~0u; ///< where a known run begins behind the one that is being recorded
  uint64_t reports_ = 0;     ///< of the collector when it began
  unsigned pause_ = 0;       ///< blocks in front of which rules are not asked again
  RuleMemory memory_;        ///< of the moment
  /// The last run that was kept or taken over. The next one, when it goes on there, becomes a part
  /// of it: edits would leave nothing but short ones.
  uint32_t lastRun_ = ~0u, lastRunEnd_ = ~0u;
  std::optional<StraightRun> taken_; ///< what has become a part of another

  /// The moves that are being recorded, in the same way.
  std::optional<MoveRun> moves_;
  RunPlace moved_;                                                ///< up to the last block
  std::array<Interval, 2> cutArea_{emptyInterval, emptyInterval}; ///< up to the last block
  double highest_ = 0;                                            ///< up to the last block
  uint32_t offset_ = 0;                                           ///< of the block that is executed
  uint32_t lastMoves_ = ~0u, lastMovesEnd_ = ~0u;
  std::optional<MoveRun> takenMoves_;
  uint32_t nextMoves_ = 0; ///< begin of a known run of moves; none lies between here and there
  unsigned streak_ = 0;    ///< blocks in a row that only went on
};

} // namespace ncvet
