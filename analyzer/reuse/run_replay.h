// Goes over runs that are known already, for who asks for states alone.
#pragma once

#include "analyzer/reuse/run_cache.h"

namespace ncvet {

/// At work while the first program of a file is followed straight on, after a check has followed
/// the same text. Rules are not asked, and nothing is recorded or forgotten.
class RunReplay {
public:
  explicit RunReplay(StraightRuns &runs) : runs_(runs) {}

  /// Before the block at `offset`, which one state alone reaches: takes over what a known run
  /// from here does, of those that `may` allows, or the rest of one that was allowed only in part.
  /// Nothing: the block is to be executed.
  std::optional<RunPlace> takeOver(uint32_t offset, MachineState &state, PlainRun &plain,
                                   llvm::function_ref<bool(const RunPlace &)> may);
  /// The next block is not executed straight on.
  void interrupt() { partly_.reset(); }

private:
  /// A run that is executed as far as somebody looks at its blocks, and how it ends.
  struct Partly {
    RunPlace place;
    MachineState exit;
    PlainRun plain;
  };

  StraightRuns &runs_;
  std::optional<Partly> partly_;
};

} // namespace ncvet
