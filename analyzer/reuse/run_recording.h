// Records the runs of one kind.
#pragma once

#include "analyzer/reuse/recorded_run.h"

namespace ncvet {

/// The run that is being recorded, and the last one that is known.
class RunTrack {
public:
  /// `longest`: so many blocks are enough for a run.
  explicit RunTrack(RunStore<StraightRun> *runs, unsigned longest = longestRun)
      : runs_(runs), longest_(longest) {}

  bool isRecording() const { return run_.has_value(); }
  /// `memory`, here and below: what rules remember at this moment.
  void begin(uint32_t offset, const MachineState &state, const PlainRun &plain,
             const RuleMemory &memory, uint64_t reports);
  /// Something was looked at, set or added since it began.
  void collect(const StateUse &use, const FileIndex::Looks &looks, const CutArea::Box &cut,
               const DepthMoves &depth);
  /// A block was executed.
  void take(const Block &block, bool clean) {
    take({block.begin, block.end}, 1);
    clean_ &= clean;
  }
  /// So many were that are as clean as one before them, of which the last one is there.
  void take(std::pair<uint32_t, uint32_t> last, uint64_t blocks) {
    here_.blocks += blocks;
    here_.lastBegin = last.first;
    here_.lastEnd = last.second;
  }
  /// A run of another store was taken over.
  void take(const StraightRun &run);
  /// Blocks that were executed since it was last seen whether they still are a run.
  uint64_t unseen() const { return here_.blocks - run_->blocks; }
  /// Blocks up to the last time.
  uint64_t seen() const { return run_->blocks; }
  /// Whether rules remember what they did when it began.
  bool mayEnd(const RuleMemory &memory) const { return run_->memory.isSame(memory, use_.aside); }
  /// What was executed up to `end` belongs to the run, if it still is one.
  bool mark(uint32_t end, const MachineState &state, const PlainRun &plain,
            const RuleMemory &memory, Gatherings gathered);
  bool isEmpty() const { return here_.blocks == 0; }
  bool isFull() const { return here_.blocks >= longest_; }
  uint64_t reports() const { return reports_; } ///< of the collector when it began
  /// Begin of a known run after it.
  uint32_t nextKnown() const { return nextKnown_; }
  /// What is recorded up to the last mark is a run that is known from now on.
  void keep();
  void drop() { run_.reset(); }

  /// The run that begins at `offset` when it does the same from here, or the one that was there
  /// before it, or null.
  const StraightRun *find(uint32_t offset, const MachineState &state, const PlainRun &plain,
                          const RuleMemory &memory);
  /// Takes over what `run`, which `find` has found, does. Runs that follow each other become one:
  /// edits would leave nothing but short ones.
  void takeOver(const StraightRun &run, MachineState &state, PlainRun &plain,
                const RuleMemory &memory);

private:
  RunStore<StraightRun> *runs_;
  unsigned longest_;
  std::optional<StraightRun> run_; ///< up to the last mark
  RunPlace here_;                  ///< up to the last block
  OriginState origin_;             ///< when it began
  StateUse use_;
  FileIndex::Looks looks_;
  CutArea::Box cut_ = CutArea::none;
  DepthMoves depth_;
  bool clean_ = true;
  uint64_t reports_ = 0;
  uint32_t nextKnown_ = ~0u;
  uint32_t lastRun_ = ~0u, lastEnd_ = ~0u; ///< that was kept or taken over
};

} // namespace ncvet
