// Runs of blocks of a region of which an earlier analysis knows what they do.
#include "analyzer/flow/region_run.h"

namespace ncvet {

/// Goes over a run of blocks of which an earlier analysis knows what it does.
bool RegionRun::takeOverRun() {
  if (at_ == refused_)
    return false;
  refused_ = at_;
  if (lives_.size() != 1 || !activation_.pending.isEmpty() || at_ < activation_.high) {
    interruptRecord();
    return false;
  }
  // What is not in step with the state begins anew with the next block.
  PlainRun present = synced_ ? plainRun_ : PlainRun();
  const auto may = [&](const RunPlace &run) { return mayTakeOver(run); };
  const auto known = recorder_ ? recorder_->takeOver(at_, lives_[0].state, present, may)
                               : replay_->takeOver(at_, lives_[0].state, present, may);
  if (!known)
    return false;
  follow(*known);
  endStretch();
  before_ = lives_[0].state;
  copied_ = true;
  synced_ = &*lives_[0].state;
  done_ = nullptr;
  modes_ = 0;
  plainRun_ = present;
  at_ = known->end;
  refused_ = ~0u;
  return true;
}

/// A run is executed all the same where somebody wants to see what happens in it, and where a
/// subprogram that was called begins in it.
bool RegionRun::mayTakeOver(const RunPlace &known) const {
  if (run_.listeners.mustSee(unit_.source.id(), known.begin, known.end))
    return false;
  const auto target = run_.used.localSubprograms.lower_bound(known.begin);
  const auto finished = run_.used.finishedAhead.lower_bound(known.begin);
  return (target == run_.used.localSubprograms.end() || *target >= known.end) &&
         (finished == run_.used.finishedAhead.end() || finished->first >= known.end);
}

/// Takes over what a run of an earlier analysis has done, but for the state.
void RegionRun::follow(const RunPlace &known) {
  if (known.begin != activation_.runEnd) {
    run_.cover(unit_, activation_.runBegin, activation_.runEnd);
    activation_.runBegin = known.begin;
  }
  activation_.runEnd = activation_.high = known.end;
  activation_.lastBegin = known.lastBegin;
  activation_.lastEnd = known.lastEnd;
  activation_.executedAny = true;
  run_.blocks += known.blocks;
  run_.steps += known.blocks;
  if (isCancelled()) {
    run_.stopped = true;
    run_.cut(blockRange(), "cancelled");
  }
}

} // namespace ncvet
