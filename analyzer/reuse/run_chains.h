// Records runs of runs, so that a long text is reused in few steps.
#pragma once

#include "analyzer/reuse/run_cache.h"
#include "analyzer/reuse/run_recording.h"

namespace ncvet {

/// The chains of one analysis. Merges adjacent reused runs into chains, in two levels. A chain does
/// what its parts do together, and the parts stay.
class RunChains {
public:
  explicit RunChains(StraightRuns *runs);

  static constexpr size_t levels = std::tuple_size_v<decltype(StraightRuns::chains)>;

  bool isRecording() const {
    return llvm::any_of(levels_, [](const Level &level) { return level.track.isRecording(); });
  }
  /// `run`, a chain of `level` or for 0 a run alone, is about to be taken over at its begin.
  void take(size_t level, const StraightRun &run, const MachineState &state, const PlainRun &plain,
            const RuleMemory &memory);
  /// The chain of `level`, from 1, that can be taken over from here, or null.
  const StraightRun *find(size_t level, uint32_t offset, const MachineState &state,
                          const PlainRun &plain, const RuleMemory &memory) {
    return levels_[level - 1].track.find(offset, state, plain, memory);
  }
  /// Takes over a chain that `find` has found.
  void takeOver(size_t level, const StraightRun &chain, MachineState &state, PlainRun &plain,
                const RuleMemory &memory) {
    levels_[level - 1].track.takeOver(chain, state, plain, memory);
  }
  /// Here something else follows.
  void end(uint32_t offset, const MachineState &state, const PlainRun &plain,
           const RuleMemory &memory) {
    for (Level &level : levels_)
      end(level, offset, state, plain, memory);
  }
  void drop() {
    for (Level &level : levels_)
      level.track.drop();
  }

private:
  struct Level {
    RunTrack track;
    unsigned parts = 0; ///< of the chain that is being recorded
  };
  static void end(Level &level, uint32_t offset, const MachineState &state, const PlainRun &plain,
                  const RuleMemory &memory);

  std::array<Level, levels> levels_;
};

} // namespace ncvet
