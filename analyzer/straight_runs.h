// Runs of plain blocks that an earlier analysis of almost the same text has followed.
#pragma once

#include "analyzer/plain_run.h"
#include "analyzer/rule_memory.h"

namespace ncvet {

/// A run of blocks that are executed one after the other, of which no rule had anything to say.
/// Where it begins again in the same text, in the same state and with rules that remember the same,
/// it ends as it did.
struct StraightRun {
  uint32_t begin = 0, end = 0;         ///< [begin, end) in the text
  uint32_t from = 0, to = 0;           ///< the text that was looked at for it
  uint32_t lastBegin = 0, lastEnd = 0; ///< its last block with content
  uint64_t blocks = 0;                 ///< with content
  MachineState entry, exit;
  PlainRun plainEntry, plainExit;
  RuleMemory memory; ///< at its begin, and at its end as well

  explicit StraightRun(FileId file) : memory(file) {}
};

/// The runs of one file, from one analysis to the next. Belongs to one thread.
class StraightRuns {
public:
  /// Blocks of a run: enough that a text has few of them, so few that an edit costs little.
  static constexpr unsigned longest = 512;
  static constexpr unsigned shortest = 16;

  /// Every run that has seen the changed text is forgotten, those behind it move.
  void edit(const TextChange &change);
  void clear() { runs_.clear(); }
  /// The run that begins at `offset`, or null.
  const StraightRun *find(uint32_t offset) const;
  /// Begin of the first run behind `offset`; `~0u`: there is none.
  uint32_t nextBehind(uint32_t offset) const;
  void insert(StraightRun run);
  void erase(uint32_t offset) { runs_.erase(offset); }
  uint64_t blocks() const; ///< with content, in all runs

private:
  std::map<uint32_t, StraightRun> runs_; ///< by begin; they do not overlap
};

} // namespace ncvet
