// Records the runs of one kind: from where, up to where, and with what in between.
#include "analyzer/reuse/run_recording.h"

namespace ncvet {

namespace {

/// After it rules only say less.
constexpr uint64_t silencing = bitOf(Fact::UnknownCode);

} // namespace

void RunTrack::begin(uint32_t offset, const MachineState &state, const PlainRun &plain,
                     const RuleMemory &memory, uint64_t reports) {
  run_.emplace(memory.file());
  run_->begin = run_->end = run_->from = run_->to = offset;
  run_->entry = state;
  run_->plainEntry = plain;
  run_->memory = memory;
  origin_ = state.origin;
  here_ = *run_;
  use_ = {};
  looks_ = {};
  cut_ = CutArea::none;
  depth_ = {};
  clean_ = true;
  reports_ = reports;
  nextKnown_ = runs_->next(offset + 1);
}

void RunTrack::collect(const StateUse &use, const FileIndex::Looks &looks, const CutArea::Box &cut,
                       const DepthMoves &depth) {
  if (!run_)
    return;
  use_ |= use;
  looks_ |= looks;
  for (size_t axis = 0; axis < cut.size(); ++axis)
    cut_[axis] = join(cut_[axis], cut[axis]);
  depth_.add(depth);
}

void RunTrack::take(const StraightRun &run) {
  here_.blocks += run.blocks;
  here_.lastBegin = run.lastBegin;
  here_.lastEnd = run.lastEnd;
  clean_ &= run.isClean;
  collect(run.use, {run.from, run.to, false}, run.cut, run.depth);
}

bool RunTrack::mark(uint32_t end, const MachineState &state, const PlainRun &plain,
                    const RuleMemory &memory, Gatherings gathered) {
  StraightRun &run = *run_;
  if (looks_.anywhere || !run.memory.isSame(memory, use_.aside))
    return false;
  here_.end = end;
  run.RunPlace::operator=(here_);
  run.from = std::min(run.from, looks_.from);
  run.to = std::max({run.to, end, looks_.to});
  run.isClean = clean_;
  // An unknown code only silences rules, so a silent run stays silent after one.
  StateUse use = use_;
  if (!((run.entry.factsMay | state.factsMay) & silencing))
    use.facts &= ~silencing;
  run.cut = cut_;
  run.depth = depth_;
  run.finish(use, origin_, state, plain);
  run.gathered = std::move(gathered);
  return true;
}

void RunTrack::keep() {
  if (run_->blocks >= shortestRun) {
    lastRun_ = run_->begin;
    lastEnd_ = run_->end;
    runs_->insert(std::move(*run_));
  }
  run_.reset();
}

const StraightRun *RunTrack::find(uint32_t offset, const MachineState &state, const PlainRun &plain,
                                  const RuleMemory &memory) {
  const StraightRun *run = runs_->find(offset);
  if (!run || run->begins(state, plain, memory))
    return run;
  return runs_->exchange(
      offset, [&](const StraightRun &earlier) { return earlier.begins(state, plain, memory); });
}

void RunTrack::takeOver(const StraightRun &run, MachineState &state, PlainRun &plain,
                        const RuleMemory &memory) {
  StraightRun *const before = lastEnd_ == run.begin ? runs_->find(lastRun_) : nullptr;
  if (before && before->end == run.begin && before->blocks + run.blocks <= longest_ &&
      !((before->use.facts ^ run.use.facts) & silencing)) {
    run.carry(state, plain);
    before->join(run, state, plain);
    before->memory = memory;
    lastEnd_ = run.end;
    runs_->erase(run.begin);
    return;
  }
  lastRun_ = run.begin;
  lastEnd_ = run.end;
  if (run.blocks >= longest_)
    return run.carry(state, plain);
  // Another may become a part of it: then what it leaves alone must be what it is here.
  StraightRun &whole = *runs_->find(run.begin);
  const KnownState entry = state;
  const PlainRun plainEntry = plain;
  run.carry(state, plain);
  whole.entry = entry;
  whole.plainEntry = plainEntry;
  whole.exit = state;
  whole.plainExit = plain;
}

} // namespace ncvet
