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
  /// A block was executed, and the next one follows.
  void executed(const Block &block) {
    if (recording_)
      take(block);
  }
  /// What is being recorded is no run. Returns null.
  const StraightRun *interrupt() {
    if (recording_)
      keep();
    return nullptr;
  }

private:
  void take(const Block &block);
  bool mark(uint32_t end, const MachineState &state, const PlainRun &plain);
  void keep();
  void begin(uint32_t offset, const MachineState &state, const PlainRun &plain);
  bool goesOnAs(const StraightRun &run, const MachineState &state, const PlainRun &plain);

  StraightRuns *runs_;
  FileUnit &unit_;
  const Dispatcher &dispatcher_;
  const Collector &collector_;
  /// Its end is the last place up to which it is known to be a run; 0: there is none yet.
  std::optional<StraightRun> recording_;
  uint64_t blocks_ = 0; ///< executed since its begin, with content
  uint32_t lastBegin_ = 0, lastEnd_ = 0;
  uint32_t nextKnown_ = ~0u; ///< where a known run begins behind the one that is being recorded
  uint64_t reports_ = 0;     ///< of the collector when it began
  unsigned pause_ = 0;       ///< blocks in front of which rules are not asked again
  RuleMemory memory_;        ///< of the moment
};

} // namespace ncvet
