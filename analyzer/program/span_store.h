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

/// Runs that do not overlap, and of each place the one that was there before: who takes an edit
/// back finds what was known. Runs stay where they are in memory.
template <typename Run>
class RunStore {
public:
  void clear() {
    runs_.clear();
    earlier_.clear();
  }
  /// The run that begins at `offset`, or null.
  const Run *find(uint32_t offset) const {
    const auto at = from(runs_, offset);
    return isAt(runs_, at, offset) ? at->get() : nullptr;
  }
  Run *find(uint32_t offset) {
    const auto at = from(runs_, offset);
    return isAt(runs_, at, offset) ? at->get() : nullptr;
  }
  /// Begin of the first run at `offset` or after it; `~0u`: there is none.
  uint32_t next(uint32_t offset) const {
    const auto at = from(runs_, offset);
    return at == runs_.end() ? ~0u : (*at)->begin;
  }
  /// Runs that begin inside of the new one have been overtaken.
  void insert(Run run) { put(runs_, std::make_unique<Run>(std::move(run))); }
  void erase(uint32_t offset) {
    const auto at = from(runs_, offset);
    if (isAt(runs_, at, offset))
      runs_.erase(at);
  }
  /// The run at `offset` is not the one that is wanted: it becomes the earlier one, and the one
  /// that was that takes its place, if it `fits`. The run that is there then, or null.
  template <typename Fits>
  Run *exchange(uint32_t offset, Fits fits) {
    Owned present = take(runs_, offset), before = take(earlier_, offset);
    put(earlier_, std::move(present));
    return before && fits(*before) ? put(runs_, std::move(before)) : nullptr;
  }
  /// Runs of which `spoils` says so are forgotten; it moves the others.
  template <typename Spoils>
  void edit(Spoils spoils) {
    for (Runs *runs : {&runs_, &earlier_})
      runs->erase(
          std::remove_if(runs->begin(), runs->end(), [&](auto &run) { return spoils(*run); }),
          runs->end());
  }
  uint64_t blocks() const { ///< with content, in all runs
    uint64_t blocks = 0;
    for (const auto &run : runs_)
      blocks += run->blocks;
    return blocks;
  }

private:
  using Owned = std::unique_ptr<Run>;
  using Runs = std::vector<Owned>; ///< by begin

  template <typename Of>
  static auto from(Of &runs, uint32_t offset) {
    return std::lower_bound(runs.begin(), runs.end(), offset,
                            [](const auto &run, uint32_t o) { return run->begin < o; });
  }
  template <typename At>
  static bool isAt(const Runs &runs, At at, uint32_t offset) {
    return at != runs.end() && (*at)->begin == offset;
  }
  static Owned take(Runs &runs, uint32_t offset) {
    const auto at = from(runs, offset);
    if (!isAt(runs, at, offset))
      return nullptr;
    Owned run = std::move(*at);
    runs.erase(at);
    return run;
  }
  static Run *put(Runs &runs, Owned run) {
    const auto first = from(runs, run->begin),
               last = from(runs, std::max(run->end, run->begin + 1));
    const auto at = runs.erase(first, last);
    return runs.insert(at, std::move(run))->get();
  }

  Runs runs_, earlier_;
};

} // namespace ncvet
