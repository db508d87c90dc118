// Follows a program as its control would: calls, jumps, loops, block skip, profiles.
#pragma once

#include "analyzer/flow/analysis_result.h"
#include "analyzer/flow/block_flow.h"
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
  Engine(Project &project, FileUnit &unit, const RuleSelection &rules, const AnalysisLimits &limits,
         const std::atomic<bool> *cancel, StraightRuns *runs = nullptr);

  AnalysisResult run();
  /// Runs the file's first program along one path only: block skip off, and no further than to
  /// where something unknown decides. No findings are made.
  void follow(BlockWatcher &watcher);
  /// Runs as `run` does, and gives the states that came by a block.
  StatesAt observe(ObservedBlock &block);

private:
  Exits execute(const Region &region, Lives entry) override;
  void runMainProgram();
  void runOtherPrograms();
  void runOtherSubprograms();
  void finish();
  Lives startOf(bool subprogram) const;

  const std::atomic<bool> *cancel_;
  StraightRuns *const runs_; ///< null: every block is executed
  BlockFlow flow_;
};

} // namespace ncvet
