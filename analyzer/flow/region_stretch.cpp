// Stretches of a region: blocks that only go on as the one before, executed at the cost of their
// numbers. What they do is what the general way in region_run.cpp does.
#include "analyzer/flow/region_run.h"
#include "interp/state/copy_motion.h"

namespace ncvet {

/// The next block is the first of its stretch.
void RegionRun::endStretch() {
  ++run_.stretch;
  goesOn_ = false;
  repeats_ = 0;
}

/// Blocks that only go on as the one before and are spelled as it: they are read and made without
/// finding out again what they are. False: there is none, at least not here.
bool RegionRun::goOnInStretch() {
  if (!quick_ || !goesOn_ || !pattern_ || run_.inFull || !mayGoOn())
    return false;
  Live &live = lives_[0];
  if (moveStretch_ != run_.stretch) {
    moveStretch_ = run_.stretch;
    if (!masks_)
      masks_.emplace(*unit_.dialect, unit_.machine);
    move_.reset();
    if (quick_->isPattern(*pattern_))
      move_ = makePlainMove(*unit_.dialect, unit_.machine, *masks_, unit_.source.id(), *block_,
                            live.state, *outcome_);
  }
  if (!move_)
    return false;
  line_.forget(); // the block before may be spelled in another way
  const uint32_t first = at_;
  while (pattern_ && !run_.stopped && mayGoOn() && !takeOver()) {
    if (!readOver())
      break;
    if (noteRead() && spend())
      goOnOnce(live);
    if (!nobodyIsTold())
      continue;
    if (recorder_)
      goOnRecorded(live);
    else
      goOnUntold(live);
  }
  return at_ != first;
}

/// Reads the next block over the one before it, past lines that are empty; false: it is another.
bool RegionRun::readOver() {
  while (!readOne(at_))
    if (!passEmptyLines() || !mayGoOn() || takeOver()) {
      pattern_ = nullptr;
      return false;
    }
  return true;
}

/// Whether nobody who listens is told of further blocks of the stretch.
bool RegionRun::nobodyIsTold() const {
  return !replay_ && run_.used.localSubprograms.empty() && run_.used.finishedAhead.empty() &&
         run_.listeners.sleepThrough(run_.stretch);
}

/// As `goOnInStretch` where nobody is told of the blocks, but perhaps of those that lead nowhere.
void RegionRun::goOnUntold(Live &live) {
  if (!mayGoOn())
    return;
  // What else `mayGoOn` asks changes in none of these blocks.
  const uint32_t limit = straightLimit();
  const bool wantStill = run_.listeners.wantStill();
  keepBefore(live.state);
  done_ = nullptr;
  while (!run_.stopped && at_ < limit && readOver() && noteRead() && spend()) {
    if (makeUntold(live.state) && wantStill)
      tellStill(live);
    at_ = next_;
    if (firstTime_ && countsOnce() && !block_->tapeInside)
      goOnAtOnce(live, limit, wantStill);
  }
}

/// Makes the move that was read; whether it leads nowhere.
bool RegionRun::makeUntold(MachineState &state) {
  if (!outcome_->codes.empty())
    keepOrigins(state);
  // Nobody looks at more of what was before the block than at its places.
  return move_->goOn(*block_, unit_.source.id(), before_, state);
}

void RegionRun::tellStill(Live &live) {
  copyMotion(before_, live.state); // the block before it has led there
  run_.visits.begin();
  run_.visits.visit(live.path);
  run_.listeners.executed(stepOf(live), true, run_.stopped);
  run_.endStop();
}

/// Some further blocks of a text that is executed for the first time, which are counted together.
void RegionRun::goOnAtOnce(Live &live, uint32_t limit, bool wantStill) {
  constexpr uint64_t most = cancelInterval / 4;
  const uint32_t first = at_;
  uint32_t last = first, end = first;
  uint64_t made = 0;
  bool isStill = false;
  const llvm::StringRef text = unit_.source.text();
  const char begin = text[block_->begin]; // by far the most others are told by it
  while (made < most && end < limit && !isStill && text[end] == begin && readOne(end)) {
    isStill = makeUntold(live.state) && wantStill;
    last = std::exchange(end, block_->next);
    activation_.lastEnd = block_->end;
    ++made;
  }
  if (!made)
    return;
  noteText(end);
  run_.blocks += made;
  activation_.lastBegin = last;
  at_ = last;
  if (countSteps(made) && isStill)
    tellStill(live);
  at_ = end;
}

/// As `goOnUntold`, up to where what is recorded has to be looked at. What blocks and sleeping
/// rules look at was noted at the first block after the last time.
void RegionRun::goOnRecorded(Live &live) {
  if (!mayGoOn() || block_->skip >= 0 || run_.stopped)
    return;
  const auto [most, before] = recorder_->unasked(at_);
  const uint32_t limit = std::min(before, straightLimit());
  const bool wantStill = run_.listeners.wantStill();
  std::pair<uint32_t, uint32_t> last;
  uint64_t made = 0;
  bool isStill = false;
  while (made < most && at_ < limit && !isStill && readOne(at_) && noteRead() && spend()) {
    keepBefore(live.state);
    done_ = nullptr;
    move_->make(*block_, unit_.source.id(), before_, live.state);
    isStill = wantStill && move_->leadsNowhere(before_, live.state);
    if (isStill)
      break;
    last = {block_->begin, block_->end};
    at_ = next_;
    ++made;
  }
  if (made)
    recorder_->executedUnasked(last, made);
  if (!isStill)
    return;
  run_.visits.begin();
  run_.visits.visit(live.path);
  tellOnce(live);
}

/// Whether the block at `at_` follows straight on, for one state that has the facts of the last
/// one.
bool RegionRun::mayGoOn() const { return goesStraight() && plainRun_.repeats(lives_[0].state); }

/// As `executeBlock`, of a block of the stretch.
void RegionRun::goOnOnce(Live &live) {
  run_.visits.begin();
  keepBefore(live.state);
  done_ = nullptr;
  move_->make(*block_, unit_.source.id(), before_, live.state);
  stateUse |= blockUse_;
  run_.visits.visit(live.path);
  if (block_->number >= 0 && region_.kind == RegionKind::Main && &unit_ == &run_.unit)
    runsInto(live);
  tellOnce(live);
}

/// Tells of a block of the stretch that was executed, after what is looked at before that.
void RegionRun::tellOnce(Live &live) {
  run_.listeners.executed(stepOf(live), true, run_.stopped);
  run_.endStop();
  at_ = next_;
  if (recorder_)
    recorder_->executed(*block_, true);
}

} // namespace ncvet
