// Records runs of plain blocks: where one begins and ends, and when it can be taken over.
#include "analyzer/run_recorder.h"

namespace ncvet {

namespace {

/// After so many blocks it is seen whether they still are a run.
constexpr unsigned step = 32;

} // namespace

RunRecorder::RunRecorder(StraightRuns *runs, FileUnit &unit, const Dispatcher &dispatcher,
                         const Collector &collector)
    : runs_(runs), unit_(unit), dispatcher_(dispatcher), collector_(collector),
      memory_(unit.source.id()) {}

const StraightRun *RunRecorder::at(uint32_t offset, const MachineState &state,
                                   const PlainRun &plain) {
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
  if (const StraightRun *run = runs_->find(offset)) {
    if (goesOnAs(*run, state, plain))
      return run;
    runs_->erase(offset);
  }
  begin(offset, state, plain);
  return nullptr;
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
  nextKnown_ = runs_->nextBehind(offset);
  reports_ = collector_.reports();
  unit_.index.takeLooks();
}

void RunRecorder::take(const Block &block) {
  if (collector_.reports() != reports_ || !block.items.empty() || block.skip >= 0)
    return keep();
  ++blocks_;
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
  run.lastBegin = lastBegin_;
  run.lastEnd = lastEnd_;
  run.exit = state;
  run.plainExit = plain;
  return true;
}

void RunRecorder::keep() {
  if (recording_->blocks >= StraightRuns::shortest)
    runs_->insert(std::move(*recording_));
  recording_.reset();
}

} // namespace ncvet
