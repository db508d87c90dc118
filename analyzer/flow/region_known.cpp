// Blocks of a region that are spelled as one before them: what they do is done again with their
// numbers, where the modes are the same. It is what the general way in region_run.cpp does.
#include "analyzer/flow/region_run.h"
#include "interp/evaluate/variable_access.h"
#include "interp/execute/make_known_move.h"
#include "interp/state/copy_motion.h"
#include "interp/state/modes_number.h"

namespace ncvet {

namespace {

/// Blocks of a spelling of which nothing could be known: then it is not tried again.
constexpr unsigned hopeless = 8;

} // namespace

/// Whether the block at `at_` is neither executed again nor of a program that is called.
bool RegionRun::isStraight() const { return at_ >= activation_.high && run_.callStack.empty(); }

/// Whether the block at `at_` is looked at by its spelling: it is not executed again, or seldom, in
/// a program of the file that is called.
bool RegionRun::readsBySpelling() {
  if (isStraight())
    return true;
  const bool mayBe =
      at_ >= activation_.high && quick_ && !run_.inFull && &unit_ == &run_.unit &&
      (region_.kind == RegionKind::Subprogram || region_.kind == RegionKind::LocalSubprogram);
  if (!mayBe)
    return false;
  if (std::exchange(askedAt_, at_) != at_)
    seldom_ = run_.readBlocks.isSeldom(unit_, at_);
  return seldom_;
}

/// Reads the next block of the text, which is executed for the first time.
void RegionRun::readStraight() {
  kept_ = nullptr;
  if (!quick_ || run_.inFull) {
    unit_.reader->read(at_, own_);
    block_ = pattern_ = &own_;
    return;
  }
  if (!known_ && !run_.callStack.empty())
    known_ = run_.readBlocks.borrow(unit_);
  if (!known_)
    known_ = std::make_unique<KnownBlocks>(*quick_, knownCoordinates(*unit_.dialect));
  if (std::exchange(spelled_, ~0u) != at_)
    spelling_ = known_->read(at_);
  if (!spelling_) {
    unit_.reader->read(at_, own_);
    spelling_ = known_->find(own_);
  }
  block_ = pattern_ = spelling_ ? &spelling_->block : &own_;
}

/// Blocks one after the other of which it is known what they do. False: there is none, at least not
/// here.
bool RegionRun::goOnAsKnown() {
  if (!modes_ || !known_ || run_.inFull || run_.listeners.watchArrivals())
    return false;
  if (!goesStraight())
    return false;
  const uint32_t first = at_, limit = straightLimit();
  const bool isMain = isStraight();
  while (!run_.stopped && at_ < limit && (isMain || readsBySpelling()) && !takeOver()) {
    KnownBlocks::Known *const known = knownHere();
    if (!known && !spelling_ && passEmptyLines())
      continue;
    if (!known)
      break;
    if (noteRead() && spend())
      goOnAsKnownOnce(*known);
    if (known->move.hole != HoleEnd::None)
      goOnInRow(*known);
    if (goesOn_)
      break; // with a stretch
  }
  return at_ != first;
}

/// What the block at `at_` does; null, with its spelling made out: that is not known.
KnownBlocks::Known *RegionRun::knownHere() {
  if (std::exchange(rowEnd_, ~0u) != at_)
    spelling_ = known_->read(at_);
  spelled_ = at_;
  pattern_ = nullptr;
  kept_ = nullptr;
  if (!spelling_ || spelling_->refused >= hopeless)
    return nullptr;
  KnownBlocks::Known *const known = known_->find(*spelling_, modesHere());
  if (!known)
    return nullptr;
  spelled_ = ~0u;
  block_ = pattern_ = &spelling_->block;
  return known;
}

/// As `executeBlock`.
void RegionRun::goOnAsKnownOnce(KnownBlocks::Known &known) {
  Live &live = lives_[0];
  run_.visits.begin();
  keepBefore(live.state);
  make(known, live);
  tell(live);
  run_.endStop();
  at_ = next_;
  if (recorder_)
    recorder_->executed(*block_, goesOn_);
}

/// Makes `before_` the state, from which it only differs by what the block before did.
void RegionRun::keepBefore(const MachineState &state) {
  if (std::exchange(copied_, false))
    return;
  if (done_)
    return done_->move.catchUp(state, before_);
  if (calculated_)
    return keepVariables(state);
  keepMotion(state);
  if (!outcome_->plainMove)
    static_cast<ModeState &>(before_) = state;
}

/// The same after a block that has changed no modes.
void RegionRun::keepMotion(const MachineState &state) {
  copyMotion(before_, state);
  keepOrigins(state);
}

/// Of codes that the block before has named though they were in force.
void RegionRun::keepOrigins(const MachineState &state) {
  for (const CodeUse &use : outcome_->codes) {
    const GroupIndex group = unit_.dialect->codes[use.code].group;
    before_.origin.all()[group] = state.origin.all()[group];
  }
}

/// The same after a block that has changed nothing but variables.
void RegionRun::keepVariables(const MachineState &state) {
  if (wrote_) { // the two keep lists of their own
    if (written_)
      writeVariable(before_, int64_t(written_), value_);
    return;
  }
  before_.locals = state.locals;
  before_.commons = state.commons;
  before_.seeksBranch = state.seeksBranch;
}

/// Does what such blocks do in these modes; false: it is not known.
bool RegionRun::doAsKnown(Live &live) {
  if (lives_.size() != 1 || decision_ != Truth::Unknown || spelling_->refused >= hopeless) {
    modes_ = 0;
    return false;
  }
  if (!modes_)
    modes_ = modesNumber(*unit_.dialect, live.state);
  KnownBlocks::Known *const known = known_->find(*spelling_, modesHere());
  if (known)
    make(*known, live);
  return known;
}

/// Makes the move, or the hole.
void RegionRun::make(KnownBlocks::Known &known, Live &live) {
  done_ = &known;
  calculated_ = false;
  outcome_ = &known.outcome;
  noteUse(known.use);
  known.move.make(*block_, unit_.source.id(), before_, live.state, known.outcome, numbers_);
  leaveModes(known, live.state);
}

/// The modes after such a block: those that it has left before in such a case.
void RegionRun::leaveModes(KnownBlocks::Known &known, const MachineState &state) {
  const size_t variant = known.move.variantOf(state);
  if (!known.after[variant]) {
    known.after[variant] = modesNumber(*unit_.dialect, state);
    known.number[variant] = ++run_.knownBlocks;
  }
  modes_ = known.after[variant];
  known.outcome.known = known.number[variant];
}

/// The block was executed in full, in `modes_`: finds out what others like it do.
void RegionRun::learn(Live &live) {
  const uint64_t modes = std::exchange(modes_, 0);
  if (!known_->meetsAgain(*spelling_, modes ^ caller_))
    return;
  if (!masks_)
    masks_.emplace(*unit_.dialect, unit_.machine);
  auto move = makeKnownMove(*unit_.dialect, unit_.machine, *masks_, unit_.source.id(), *block_,
                            before_, live.state, *outcome_, blockUse_);
  if (!move) {
    ++spelling_->refused;
    return;
  }
  KnownBlocks::Known &known = known_->add(*spelling_, modes ^ caller_);
  known.move = std::move(*move);
  known.outcome = *outcome_;
  known.use = blockUse_;
  known.after.fill(0);
  leaveModes(known, live.state);
}

} // namespace ncvet
