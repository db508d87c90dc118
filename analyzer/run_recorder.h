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
  const StraightRun *at(uint32_t offset, MachineState &state, const PlainRun &plain);
  /// Takes over what `run`, which `at` has found, does; false when a rule has something to say of
  /// it after all: then its blocks are executed.
  bool takeOver(const StraightRun &run, MachineState &state, PlainRun &plain);
  /// A block was executed, and the next one follows. `goesOn`: it only goes on as the one before.
  void executed(const Block &block, bool goesOn) {
    if (runs_)
      take(block, goesOn);
  }
  /// What is being recorded is no run. Returns null.
  const StraightRun *interrupt() {
    if (runs_)
      end();
    return nullptr;
  }

private:
  void take(const Block &block, bool goesOn);
  void end();
  void collect(MachineState &state);
  const StraightRun *whole(uint32_t offset, MachineState &state, const PlainRun &plain);
  const StraightRun *stretch(uint32_t offset, MachineState &state, const PlainRun &plain);

  StraightRuns *runs_;
  FileUnit &unit_;
  const Dispatcher &dispatcher_;
  const Collector &collector_;
  RunTrack whole_;
  RunTrack stretch_;
  bool foundWhole_ = false; ///< the run that was found last
  unsigned pause_ = 0;      ///< blocks in front of which rules are not asked again
  unsigned streak_ = 0;     ///< blocks in a row that only went on
};

} // namespace ncvet
