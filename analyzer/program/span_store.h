// The runs of one kind that are known of a file, by where they begin.
#pragma once

#include "formats/text/text_change.h"

#include <algorithm>
#include <memory>
#include <vector>

namespace ncvet {

/// So many blocks make a run that is worth keeping, so many are enough: a text has few runs, and an
/// edit costs little.
constexpr unsigned shortestRun = 16;
constexpr unsigned longestRun = 512;

/// Where a run of blocks is that are executed one after the other.
struct RunPlace {
  uint32_t begin = 0, end = 0;         ///< [begin, end) in the text
  uint32_t lastBegin = 0, lastEnd = 0; ///< its last block with content
  uint64_t blocks = 0;                 ///< with content

  /// `next`, which begins where it ends, becomes a part of it.
  void extend(const RunPlace &next) {
    end = next.end;
    lastBegin = next.lastBegin;
    lastEnd = next.lastEnd;
    blocks += next.blocks;
  }
  void move(const TextChange &change) {
    for (uint32_t *place : {&begin, &end, &lastBegin, &lastEnd})
      *place = change.moved(*place);
  }
};

/// Runs that do not overlap. They stay where they are in memory.
template <typename Run>
class RunStore {
public:
  void clear() { runs_.clear(); }
  /// The run that begins at `offset`, or null.
  const Run *find(uint32_t offset) const {
    const auto at = from(offset);
    return at == runs_.end() || (*at)->begin != offset ? nullptr : at->get();
  }
  Run *find(uint32_t offset) {
    const auto at = from(offset);
    return at == runs_.end() || (*at)->begin != offset ? nullptr : at->get();
  }
  /// Begin of the first run at `offset` or after it; `~0u`: there is none.
  uint32_t next(uint32_t offset) const {
    const auto at = from(offset);
    return at == runs_.end() ? ~0u : (*at)->begin;
  }
  /// Runs that begin inside of the new one have been overtaken.
  void insert(Run run) {
    const auto first = from(run.begin), last = from(std::max(run.end, run.begin + 1));
    const auto at = runs_.erase(first, last);
    runs_.insert(at, std::make_unique<Run>(std::move(run)));
  }
  void erase(uint32_t offset) {
    const auto at = from(offset);
    if (at != runs_.end() && (*at)->begin == offset)
      runs_.erase(at);
  }
  /// Runs of which `spoils` says so are forgotten; it moves the others.
  template <typename Spoils>
  void edit(Spoils spoils) {
    runs_.erase(std::remove_if(runs_.begin(), runs_.end(), [&](auto &run) { return spoils(*run); }),
                runs_.end());
  }
  uint64_t blocks() const { ///< with content, in all runs
    uint64_t blocks = 0;
    for (const auto &run : runs_)
      blocks += run->blocks;
    return blocks;
  }

private:
  auto from(uint32_t offset) const {
    return std::lower_bound(runs_.begin(), runs_.end(), offset,
                            [](const auto &run, uint32_t o) { return run->begin < o; });
  }
  auto from(uint32_t offset) {
    return std::lower_bound(runs_.begin(), runs_.end(), offset,
                            [](const auto &run, uint32_t o) { return run->begin < o; });
  }

  std::vector<std::unique_ptr<Run>> runs_; ///< by begin
};

} // namespace ncvet
