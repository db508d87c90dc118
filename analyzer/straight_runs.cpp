// Runs of plain blocks: what an edit does to them.
#include "analyzer/straight_runs.h"

namespace ncvet {

namespace {

void move(Origin &origin, FileId file, const TextChange &change) {
  if (!origin.known() || origin.file != file)
    return;
  origin.begin = change.moved(origin.begin);
  origin.end = change.moved(origin.end);
}

void move(MachineState &state, FileId file, const TextChange &change) {
  forEachOrigin(state.origin, [&](Origin &origin) { move(origin, file, change); });
}

/// Whether something that the state tells of was set in the changed text.
bool stemsFrom(const MachineState &state, FileId file, const TextChange &change) {
  bool stems = false;
  forEachOrigin(state.origin, [&](const Origin &origin) {
    stems |= origin.known() && origin.file == file && !change.spares(origin.begin, origin.end);
  });
  return stems;
}

} // namespace

void StraightRuns::edit(const TextChange &change) {
  std::map<uint32_t, StraightRun> kept;
  for (auto &[begin, run] : runs_) {
    const FileId file = run.memory.file();
    // Text that is put in right at an end may belong to the block there.
    const bool seen = change.begin <= run.to && change.end >= run.from;
    if (seen || stemsFrom(run.entry, file, change))
      continue;
    if (run.from >= change.end)
      for (uint32_t *place :
           {&run.begin, &run.end, &run.from, &run.to, &run.lastBegin, &run.lastEnd})
        *place = change.moved(*place);
    move(run.entry, file, change);
    move(run.exit, file, change);
    run.memory.move(change);
    const uint32_t at = run.begin;
    kept.emplace_hint(kept.end(), at, std::move(run));
  }
  runs_ = std::move(kept);
}

const StraightRun *StraightRuns::find(uint32_t offset) const {
  const auto found = runs_.find(offset);
  return found == runs_.end() ? nullptr : &found->second;
}

uint32_t StraightRuns::nextBehind(uint32_t offset) const {
  const auto next = runs_.upper_bound(offset);
  return next == runs_.end() ? ~0u : next->first;
}

uint64_t StraightRuns::blocks() const {
  uint64_t blocks = 0;
  for (const auto &[begin, run] : runs_)
    blocks += run.blocks;
  return blocks;
}

void StraightRuns::insert(StraightRun run) {
  // One that begins inside of it has been overtaken.
  runs_.erase(runs_.lower_bound(run.begin), runs_.lower_bound(run.end));
  const uint32_t begin = run.begin;
  runs_.emplace(begin, std::move(run));
}

} // namespace ncvet
