// Chains of runs: when one begins, goes on and ends.
#include "analyzer/reuse/run_chains.h"

namespace ncvet {

namespace {

/// A chain is so much longer than what it is made of.
constexpr unsigned growth = 16;

} // namespace

RunChains::RunChains(StraightRuns *runs)
    : levels_{Level{RunTrack(runs ? &runs->chains[0] : nullptr, longestRun * growth)},
              Level{RunTrack(runs ? &runs->chains[1] : nullptr, longestRun * growth * growth)}} {}

void RunChains::end(Level &level, uint32_t offset, const MachineState &state, const PlainRun &plain,
                    const RuleMemory &memory) {
  if (!level.track.isRecording())
    return;
  // One part alone is known already.
  if (level.parts > 1 && level.track.mark(offset, state, plain, memory, {}))
    level.track.keep();
  else
    level.track.drop();
}

void RunChains::take(size_t level, const StraightRun &run, const MachineState &state,
                     const PlainRun &plain, const RuleMemory &memory) {
  // What rules gather is told to them run by run.
  if (!run.gathered.empty())
    return end(run.begin, state, plain, memory);
  for (size_t i = 0; i < levels; ++i) {
    Level &at = levels_[i];
    if (i < level) {
      end(at, run.begin, state, plain, memory);
      continue;
    }
    if (at.track.isRecording() && (at.track.isFull() || at.track.nextKnown() <= run.begin))
      end(at, run.begin, state, plain, memory);
    if (!at.track.isRecording()) {
      at.track.begin(run.begin, state, plain, memory, 0);
      at.parts = 0;
    }
    at.track.take(run);
    ++at.parts;
  }
}

} // namespace ncvet
