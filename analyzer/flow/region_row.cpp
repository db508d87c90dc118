// Rows of holes of a region: blocks of one cycle in force that only say where the next hole is.
// What they do is what the general way in region_known.cpp does.
#include "analyzer/flow/region_run.h"
#include "interp/state/copy_motion.h"
#include "interp/value/work_meter.h"

namespace ncvet {

namespace {

/// Holes that are told together. Fewer than `fewest` are as soon told one by one.
constexpr size_t mostTogether = 64, fewestTogether = 4;
/// Rows that nobody takes together: then it is not tried again.
constexpr unsigned mostRefused = 16;

} // namespace

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
  beginRow();
  run_.visits.begin();
  run_.visits.visit(lives_[0].path);
  while (made < most && !run_.stopped && at_ < limit) {
    if (made)
      done_->move.catchUpPlace(state, before_);
    else
      keepBefore(state);
    made += makeTogether(limit, most - made);
    spelling_ = known_->read(at_);
    rowEnd_ = at_;
    if (!spelling_ || spelling_->block.tapeInside)
      break;
    if (spelling_->serial != known->spelling) {
      known = known_->find(*spelling_, modesHere());
      if (!known || !isOfRow(*known, state))
        break;
    }
    noteKind(*known);
    rowEnd_ = spelled_ = ~0u;
    block_ = pattern_ = &spelling_->block;
    kept_ = nullptr;
    ++made;
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
  countSteps(made);
}

/// Of the kinds of holes that are known from a row before those stay that are of this one.
void RegionRun::beginRow() {
  llvm::erase_if(rowKinds_, [&](const RowKind &kind) {
    return kind.spelling->serial != kind.serial ||
           known_->find(*kind.spelling, modesHere()) != kind.known ||
           !isOfRow(*kind.known, lives_[0].state);
  });
  row_.axes.clear();
  row_.kinds.clear();
  rowLetters_.clear();
  for (RowKind &kind : rowKinds_)
    addKind(kind);
}

/// A hole of that kind was read, into the block of `spelling_`.
void RegionRun::noteKind(KnownBlocks::Known &known) {
  constexpr size_t mostKinds = 4;
  if (rowKinds_.size() >= mostKinds ||
      llvm::any_of(rowKinds_, [&](const RowKind &kind) { return kind.known == &known; }))
    return;
  RowKind kind{spelling_, spelling_->serial, &known, {}};
  if (addKind(kind))
    rowKinds_.push_back(kind);
}

/// False: its holes are not told together with those of the others.
bool RegionRun::addKind(RowKind &kind) {
  const KnownMove &move = kind.known->move;
  if (move.steps.size() > HoleRow::mostAxes)
    return false;
  const auto axes = row_.axes;
  const auto letters = rowLetters_;
  for (size_t i = 0; i < move.steps.size(); ++i) {
    const Axis axis = move.steps[i].target.axis;
    size_t at = size_t(llvm::find(row_.axes, axis) - row_.axes.begin());
    const bool isNew = at == row_.axes.size();
    if (isNew && at < HoleRow::mostAxes) {
      row_.axes.push_back(axis);
      rowLetters_.push_back(move.letters[i]);
    } else if (isNew || rowLetters_[at] != move.letters[i]) {
      row_.axes = axes;
      rowLetters_ = letters;
      return false;
    }
    kind.places[i] = uint8_t(at);
  }
  row_.kinds.push_back(&kind.known->outcome);
  return true;
}

/// Makes holes of the row that nobody has to be told of one by one, as far as another one follows;
/// how many it was. `before_` is in step, before and after it.
size_t RegionRun::makeTogether(uint32_t limit, uint64_t most) {
  if (rowsRefused_ >= mostRefused || rowKinds_.empty() || rowKinds_.size() != row_.kinds.size() ||
      most < fewestTogether || !run_.used.finishedAhead.empty())
    return 0;
  readRow(limit, std::min<uint64_t>(most, rowLength_));
  if (row_.holes.size() < fewestTogether)
    return 0;
  Live &live = lives_[0];
  const size_t made = run_.listeners.executedRow(stepOf(live), row_, row_.holes.size() - 1);
  // Where some are told one by one it is not worth while to read many before their turn.
  rowLength_ = made + 1 == row_.holes.size() ? mostTogether : std::max(made + 1, fewestTogether);
  if (!made) {
    ++rowsRefused_;
    return 0;
  }
  rowsRefused_ = 0;
  placeRow(made, live.state);
  activation_.lastBegin = row_.holes[made - 1].begin;
  activation_.lastEnd = row_.holes[made - 1].end;
  at_ = row_.holes[made - 1].next;
  return made;
}

/// Reads holes of the kinds that are known, up to `most` of them.
void RegionRun::readRow(uint32_t limit, size_t most) {
  HoleRow::Hole hole;
  row_.holes.clear();
  for (size_t i = 0; i < row_.axes.size(); ++i) {
    const Interval &at = lives_[0].state->at(row_.axes[i]);
    if (!at.isConstant())
      return;
    hole.at[i] = at.value();
  }
  size_t kind = 0;
  for (uint32_t at = at_; at < limit && row_.holes.size() < most; at = hole.next) {
    const Block *block = known_->readAhead(at, *rowKinds_[kind].spelling);
    for (size_t other = 0; !block && other < rowKinds_.size(); ++other)
      if (other != kind && (block = known_->readAhead(at, *rowKinds_[other].spelling))) {
        kind = other;
        break;
      }
    if (!block)
      return;
    const KnownMove &move = rowKinds_[kind].known->move;
    for (size_t i = 0; i < move.steps.size(); ++i)
      hole.at[rowKinds_[kind].places[i]] = block->words[move.steps[i].word].value() + 0.0;
    hole.kind = uint8_t(kind);
    hole.begin = block->begin;
    hole.end = block->end;
    hole.next = block->next;
    row_.holes.push_back(hole);
  }
}

/// Makes the state what it is after so many holes of the row.
void RegionRun::placeRow(size_t made, MachineState &state) {
  const llvm::ArrayRef<HoleRow::Hole> holes = llvm::makeArrayRef(row_.holes).take_front(made);
  const KnownMove &move = rowKinds_[0].known->move;
  for (size_t i = 0; i < row_.axes.size(); ++i) {
    Interval &position = state.at(row_.axes[i]);
    if (const auto axis = size_t(row_.axes[i]); move.tracksDepth && axis < 2) {
      Interval all = Interval::exactly(holes[0].at[i]);
      for (const HoleRow::Hole &hole : holes) {
        all.lo = std::min(all.lo, hole.at[i]);
        all.hi = std::max(all.hi, hole.at[i]);
      }
      state.cutArea.add(axis, all);
    }
    position = Interval::exactly(holes.back().at[i]);
    if (llvm::any_of(holes, [&](const HoleRow::Hole &hole) {
          return llvm::is_contained(rowKinds_[hole.kind].known->move.letters, rowLetters_[i]);
        }))
      state.cycle.value[rowLetters_[i]] = before_.cycle.value[rowLetters_[i]] = holes.back().at[i];
  }
  for (size_t axis = 0; move.tracksDepth && axis < 2; ++axis)
    if (!llvm::is_contained(row_.axes, Axis(axis)))
      state.cutArea.add(axis, state.position[axis]);
  copyMotion(before_, state);
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
  activation_.lastBegin = block_->begin;
  activation_.lastEnd = block_->end;
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
