// Records runs of plain blocks: where one begins and ends, and when it can be taken over.
#include "analyzer/run_recorder.h"

namespace ncvet {

namespace {

/// After so many blocks it is seen whether they still are a run.
constexpr unsigned step = 32;
/// So many moves that only go on let expect more of them.
constexpr unsigned worthIt = 2;

double levelOf(const MachineState &state) {
  const Interval &level = state.at(Axis::Z);
  return level.isConstant() ? level.value() : std::numeric_limits<double>::infinity();
}

} // namespace

RunRecorder::RunRecorder(StraightRuns *runs, FileUnit &unit, const Dispatcher &dispatcher,
                         const Collector &collector)
    : runs_(runs), unit_(unit), dispatcher_(dispatcher), collector_(collector),
      memory_(unit.source.id()) {}

const StraightRun *RunRecorder::at(uint32_t offset, const MachineState &state,
                                   const PlainRun &plain) {
  offset_ = offset;
  if (recording_) {
    const bool full = blocks_ - recording_->blocks >= step || offset == nextKnown_;
    if (!full)
      return nullptr;
    if (mark(offset, state, plain) && recording_->blocks < StraightRuns::longest &&
        offset != nextKnown_)
      return nullptr;
    keep();
  }
  if (state.modalCalls || state.profile != 0 || (pause_ > 0 && pause_-- > 0))
    return nullptr;
  memory_.clear();
  dispatcher_.remember(memory_);
  if (!memory_.isComparable()) {
    pause_ = step;
    return nullptr;
  }
  if (const StraightRun *run = runs_->straight.find(offset)) {
    if (goesOnAs(*run, state, plain)) {
      endMoves(offset, state);
      return joined(*run);
    }
    runs_->straight.erase(offset);
  }
  // Runs of moves end where others begin: these are met again behind them.
  endMoves(offset, state);
  begin(offset, state, plain);
  return nullptr;
}

/// The run that is taken over now: by itself, or as a part of the one in front of it.
const StraightRun *RunRecorder::joined(const StraightRun &run) {
  StraightRun *const before = lastRunEnd_ == run.begin ? runs_->straight.find(lastRun_) : nullptr;
  if (!before || before->end != run.begin || before->blocks + run.blocks > StraightRuns::longest) {
    lastRun_ = run.begin;
    lastRunEnd_ = run.end;
    return &run;
  }
  taken_ = run;
  before->extend(*taken_);
  before->from = std::min(before->from, taken_->from);
  before->to = std::max(before->to, taken_->to);
  before->isClean &= taken_->isClean;
  before->exit = taken_->exit;
  before->plainExit = taken_->plainExit;
  lastRunEnd_ = taken_->end;
  runs_->straight.erase(taken_->begin);
  return &*taken_;
}

/// The same for moves, save where another run begins between them, see `at`.
const MoveRun *RunRecorder::joined(const MoveRun &run) {
  MoveRun *const before = lastMovesEnd_ == run.begin && !runs_->straight.find(run.begin)
                              ? runs_->moves.find(lastMoves_)
                              : nullptr;
  // What the two say of the level must have been said of the same way here.
  if (!before || before->end != run.begin ||
      std::memcmp(&before->fedFrom, &run.entry.fedFrom, sizeof run.fedFrom) != 0 ||
      before->blocks + run.blocks > StraightRuns::longest) {
    lastMoves_ = run.begin;
    lastMovesEnd_ = run.end;
    return &run;
  }
  takenMoves_ = run;
  before->extend(*takenMoves_);
  before->position = takenMoves_->position;
  before->fedFrom = takenMoves_->fedFrom;
  for (unsigned i = 0; i < before->cutArea.size(); ++i)
    before->cutArea[i] = join(before->cutArea[i], takenMoves_->cutArea[i]);
  before->highest = std::max(before->highest, takenMoves_->highest);
  lastMovesEnd_ = takenMoves_->end;
  runs_->moves.erase(takenMoves_->begin);
  return &*takenMoves_;
}

bool RunRecorder::goesOnAs(const StraightRun &run, const MachineState &state,
                           const PlainRun &plain) {
  return run.plainEntry == plain && run.memory == memory_ && equal(run.entry, state) &&
         run.entry.origin == state.origin;
}

void RunRecorder::begin(uint32_t offset, const MachineState &state, const PlainRun &plain) {
  recording_.emplace(unit_.source.id());
  recording_->begin = offset;
  recording_->entry = state;
  recording_->plainEntry = plain;
  recording_->memory = memory_;
  recording_->from = offset;
  blocks_ = 0;
  clean_ = true;
  nextKnown_ = runs_->straight.next(offset + 1);
  reports_ = collector_.reports();
  unit_.index.takeLooks();
}

void RunRecorder::takeBlock(const Block &block) {
  if (collector_.reports() != reports_ || !block.items.empty() || block.skip >= 0)
    return keep();
  ++blocks_;
  clean_ &= isClean(block, *unit_.dialect);
  lastBegin_ = block.begin;
  lastEnd_ = block.end;
}

/// What was executed up to `end` belongs to the run; false when it cannot be one.
bool RunRecorder::mark(uint32_t end, const MachineState &state, const PlainRun &plain) {
  const FileIndex::Looks looks = unit_.index.takeLooks();
  memory_.clear();
  dispatcher_.remember(memory_);
  if (looks.anywhere || !(recording_->memory == memory_))
    return false;
  StraightRun &run = *recording_;
  run.end = end;
  run.from = std::min(run.from, looks.from);
  run.to = std::max({run.to, run.end, looks.to});
  run.blocks = blocks_;
  run.isClean = clean_;
  run.lastBegin = lastBegin_;
  run.lastEnd = lastEnd_;
  run.exit = state;
  run.plainExit = plain;
  return true;
}

void RunRecorder::keep() {
  if (recording_->blocks >= StraightRuns::shortest) {
    lastRun_ = recording_->begin;
    lastRunEnd_ = recording_->end;
    runs_->straight.insert(std::move(*recording_));
  }
  recording_.reset();
}

// ---------------------------------------------------------------------------------------------
// Runs of moves

const MoveRun *RunRecorder::movesAt(uint32_t offset, const MachineState &state,
                                    const PlainRun &plain) {
  if (moves_) {
    const uint64_t marked = moves_->blocks;
    if (moved_.blocks - marked >= step)
      markMoves(offset, state);
    if (moved_.blocks < StraightRuns::longest && offset != nextMoves_)
      return nullptr;
    endMoves(offset, state);
  }
  if (streak_ < worthIt || !isSettled(plain, state) || state.modalCalls || state.profile != 0 ||
      state.activeAction(*unit_.dialect, StandardGroup::Motion) != Action::Linear ||
      !dispatcher_.movesSleep(state))
    return nullptr;
  if (nextMoves_ < offset)
    nextMoves_ = runs_->moves.next(offset);
  if (nextMoves_ == offset) {
    const MoveRun *run = runs_->moves.find(offset);
    if (run->begins(*unit_.dialect, state, plain))
      return joined(*run);
    runs_->moves.erase(offset);
  }
  beginMoves(offset, state, plain);
  return nullptr;
}

void RunRecorder::beginMoves(uint32_t offset, const MachineState &state, const PlainRun &plain) {
  moves_.emplace();
  moves_->begin = moves_->end = offset;
  moves_->addresses = plain.addresses;
  moves_->entry = state;
  moves_->entry.origin = {};
  moved_ = *moves_;
  cutArea_ = {emptyInterval, emptyInterval};
  highest_ = levelOf(state);
  nextMoves_ = runs_->moves.next(offset + 1);
}

void RunRecorder::take(const Block &block, bool goesOn, const MachineState &before,
                       const MachineState &after) {
  if (recording_)
    takeBlock(block);
  streak_ = goesOn ? streak_ + 1 : 0;
  if (!moves_)
    return;
  if (goesOn)
    takeMove(block, after);
  else
    endMoves(offset_, before);
}

void RunRecorder::takeMove(const Block &block, const MachineState &after) {
  ++moved_.blocks;
  moved_.lastBegin = block.begin;
  moved_.lastEnd = block.end;
  highest_ = std::max(highest_, levelOf(after));
  for (unsigned i = 0; i < cutArea_.size(); ++i)
    if (!(after.cutArea[i] == emptyInterval)) // this control keeps it
      cutArea_[i] = join(cutArea_[i], after.position[i]);
}

void RunRecorder::took(const MoveRun &run) {
  blocks_ += run.blocks;
  lastBegin_ = run.lastBegin;
  lastEnd_ = run.lastEnd;
  streak_ = worthIt;
}

/// What was executed up to `end` belongs to the run.
void RunRecorder::markMoves(uint32_t end, const MachineState &state) {
  moves_->end = end;
  moves_->lastBegin = moved_.lastBegin;
  moves_->lastEnd = moved_.lastEnd;
  moves_->blocks = moved_.blocks;
  moves_->position = state.position;
  moves_->fedFrom = state.fedFrom;
  moves_->cutArea = cutArea_;
  moves_->highest = highest_;
}

void RunRecorder::endMoves(uint32_t end, const MachineState &state) {
  if (!moves_)
    return;
  markMoves(end, state);
  keepMoves();
}

void RunRecorder::keepMoves() {
  if (moves_->blocks >= StraightRuns::shortest) {
    lastMoves_ = moves_->begin;
    lastMovesEnd_ = moves_->end;
    runs_->moves.insert(std::move(*moves_));
  }
  moves_.reset();
  nextMoves_ = 0;
}

} // namespace ncvet
