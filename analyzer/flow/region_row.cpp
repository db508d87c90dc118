// Rows of holes of a region: blocks of one cycle in force that only say where the next hole is.
// What they do is what the general way in region_known.cpp does.
#include "analyzer/flow/region_run.h"
#include "interp/value/work_meter.h"

namespace ncvet {

/// Holes that follow one that was made as it is known: in a row of them nothing changes but where
/// they are, so that no mode is looked at, and the state before them differs in their places alone.
void RegionRun::goOnInRow(KnownBlocks::Known &first) {
  const MachineState &state = lives_[0].state;
  if (recorder_ || replay_ || !isStraight() || !countsOnce() || !isOfRow(first, state))
    return;
  const uint32_t limit = straightLimit(), begin = at_;
  constexpr uint64_t most = cancelInterval / 4; // counted together
  KnownBlocks::Known *known = &first;
  uint64_t made = 0;
  firstTime_ = true;
  run_.visits.begin();
  run_.visits.visit(lives_[0].path);
  while (made < most && !run_.stopped && at_ < limit) {
    spelling_ = known_->read(at_);
    rowEnd_ = at_;
    if (!spelling_ || spelling_->block.tapeInside)
      break;
    if (spelling_->serial != known->spelling) {
      known = known_->find(*spelling_, modesHere());
      if (!known || !isOfRow(*known, state))
        break;
    }
    rowEnd_ = spelled_ = ~0u;
    block_ = pattern_ = &spelling_->block;
    kept_ = nullptr;
    if (made++)
      done_->move.catchUpPlace(state, before_);
    else
      keepBefore(state);
    makeInRow(*known);
  }
  run_.endStop();
  if (made)
    countRow(begin, made);
}

/// Counts the holes of a row that begins at `begin`; they are executed for the first time.
void RegionRun::countRow(uint32_t begin, uint64_t made) {
  const uint32_t end = std::exchange(at_, begin);
  noteText(end);
  at_ = end;
  run_.blocks += made;
  activation_.lastBegin = block_->begin;
  activation_.lastEnd = block_->end;
  countSteps(made);
}

/// Whether it leaves all of the state as it is, but where the hole is.
bool RegionRun::isOfRow(const KnownBlocks::Known &known, const MachineState &state) const {
  return known.after[0] == modes_ && known.move.onlyPlaces(state);
}

/// As `goOnAsKnownOnce`.
void RegionRun::makeInRow(KnownBlocks::Known &known) {
  Live &live = lives_[0];
  done_ = &known;
  outcome_ = &known.outcome;
  noteUse(known.use);
  known.move.makePlace(*block_, live.state, known.outcome);
  if (block_->number >= 0 && region_.kind == RegionKind::Main && &unit_ == &run_.unit)
    runsInto(live);
  run_.listeners.executed(stepOf(live), false, run_.stopped);
  if (run_.visits.isReported()) {
    run_.endStop();
    run_.visits.begin();
    run_.visits.visit(live.path);
  }
  if (const uint64_t besides = std::exchange(workDone, 0); besides > usualWork)
    spend(besides);
  at_ = block_->next;
}

} // namespace ncvet
