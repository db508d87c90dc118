// Follows a program as its control would: calls, jumps, loops, block skip, profiles.
#pragma once

#include "analyzer/flow/block_flow.h"
#include "analyzer/flow/rule_host.h"
#include "analyzer/reuse/run_cache.h"

#include <atomic>

namespace ncvet {

/// Runs the programs of one file.
///
/// A backward jump under a known condition is run for real; under an unknown one the states at its
/// target are joined, later widened, until nothing new comes. Findings are made in every pass: the
/// first pass through a loop is a path to each of its blocks, and later states only add paths, so
/// what is reported early stays true.
class Engine final : private FlowRun {
public:
  Engine(Project &programs, FileUnit &entry, const AnalysisLimits &bounds,
         const std::atomic<bool> *cancel);

  using FlowRun::inFull;
  using FlowRun::postponed;
  using FlowRun::stale;
  using FlowRun::used;
  using FlowRun::visits;
  /// One of many files that are checked together.
  void leaveToCallers(const OuterCalls &calls) { outer = &calls; }
  void listen(FlowListener &listener) { listeners.add(listener); }
  /// Takes over what earlier runs of the file have followed under the same rules, and adds to it.
  void reuse(StraightRuns &runs, RuleHost &rules) {
    runs_ = &runs;
    rules_ = &rules;
    rules.recordUses();
  }
  /// The same of calls that the main program makes. When the run is `stale` after that, it has to
  /// be made once more, with `KnownCalls::keepPlain`.
  void reuseCalls() {
    FlowRun &run = *this;
    if (runs_ && rules_)
      flow_.reuse(calls_.emplace(run, *runs_, *rules_));
  }
  /// The same for who asks for states alone, when a check of the same text has left `runs`.
  void replay(StraightRuns &runs) { runs_ = &runs; }

  /// Runs all programs of the file.
  void run();
  /// Runs the file's main program along one path only: block skip as `skip` has it, and no further
  /// than to where something unknown decides.
  void follow(const SkipSwitches &skip);
  /// The same with block skip off.
  void follow();
  /// Takes such a run up again, where it came to the block `from` of the main program in `state`.
  void followFrom(uint32_t from, const MachineState &state);

  uint64_t blockCount() const { return blocks; }
  bool isComplete() const { return complete; }
  const std::vector<std::string> &cutsMade() const { return cuts; }
  bool hasAskedOuter() const { return asksOuter; }
  bool hasRestedOnOthers() const { return restsOnOthers; }
  uint64_t workSpent() const { return repeated; }
  /// See `AnalysisResult`.
  FollowedCallsOfFiles followedCalls() const;

private:
  Exits execute(const Region &region, Lives entry) override;
  void enter(const Region &region, EntryState entry);
  bool onlyReturns(const ProgramInfo &program) const;
  bool endsByReturn(const ProgramInfo &program) const;
  bool isContour(const ProgramInfo &program) const;
  void runMainProgram();
  void runOtherPrograms();
  void runOtherSubprograms();
  void finish();
  Lives startOf(bool subprogram) const;

  const std::atomic<bool> *cancel_;
  StraightRuns *runs_ = nullptr;    ///< null: every block is executed
  const RuleHost *rules_ = nullptr; ///< that listen
  std::optional<CallRecorder> calls_;
  BlockFlow flow_;
};

} // namespace ncvet
