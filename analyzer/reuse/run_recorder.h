// Records runs of plain blocks while a program is followed, and finds those that are known already.
#pragma once

#include "analyzer/reuse/run_chains.h"
#include "analyzer/rule/collector.h"
#include "analyzer/rule/dispatch.h"

namespace ncvet {

/// At work while the first program of a file is followed straight on.
class RunRecorder {
public:
  RunRecorder(StraightRuns &runs, FileUnit &unit, const Dispatcher &dispatcher,
              const Collector &collector);

  /// Before the block at `offset`, which one state alone reaches: takes over what a known run
  /// from here does, of those that `may` allows. Nothing: the block is to be executed.
  std::optional<RunPlace> takeOver(uint32_t offset, MachineState &state, PlainRun &plain,
                                   llvm::function_ref<bool(const RunPlace &)> may);
  /// A block was executed, and the next one follows. `goesOn`: it only goes on as the one before.
  void executed(const Block &block, bool goesOn);
  /// So many blocks that only go on, before such a place, may be executed without `takeOver` being
  /// asked before each of them: it would have nothing.
  struct Unasked {
    uint64_t blocks = 0;
    uint32_t before = 0;
  };
  Unasked unasked(uint32_t offset) const;
  /// They were, and nobody has reported anything; `last`: begin and end of the last one of them.
  void executedUnasked(std::pair<uint32_t, uint32_t> last, uint64_t blocks);
  /// The block for which `takeOver` had nothing was executed, and is not one that only goes on;
  /// `before` is the state before it, and no rule has heard of it yet.
  void goesOnNoMore(MachineState &before) {
    if (stretch_.isRecording())
      endStretchBefore(before);
  }
  /// What is being recorded is no run.
  void interrupt();

private:
  using May = llvm::function_ref<bool(const RunPlace &)>;

  void collect(MachineState &state);
  bool mayBegin(uint32_t offset, MachineState &state, const PlainRun &plain);
  void rememberMoves();
  unsigned wholeStep() const;
  void finishStretch(uint32_t offset, MachineState &state, const PlainRun &plain);
  void endStretchBefore(MachineState &before);
  std::optional<RunPlace> takeWhole(uint32_t offset, MachineState &state, PlainRun &plain, May may);
  std::optional<RunPlace> takeStretch(uint32_t offset, MachineState &state, PlainRun &plain,
                                      May may);

  StraightRuns &runs_;
  FileUnit &unit_;
  const Dispatcher &dispatcher_;
  const Collector &collector_;
  RunTrack whole_;
  RunTrack stretch_;
  RunChains chains_;
  /// How it was before a block after which it may be found that the stretch has ended there.
  struct Before {
    uint32_t offset = 0;
    StateUse use;
    FileIndex::Looks looks;
    PlainRun plain;
  };
  Before before_;
  RuleMemory memory_;        ///< of the moment, for all but stretches
  RuleMemory moves_;         ///< the same for stretches
  uint32_t executedEnd_ = 0; ///< up to here a run must be executed
  unsigned pause_ = 0;       ///< blocks before which rules are not asked again
  unsigned streak_ = 0;      ///< blocks in a row that only went on
};

} // namespace ncvet
