// Records runs of plain blocks: where one begins and ends, and when it can be taken over.
#include "analyzer/run_recorder.h"

namespace ncvet {

namespace {

/// After so many blocks it is seen whether they still are a run.
constexpr unsigned step = 32;
/// The same of blocks that only go on, which end at any other one.
constexpr unsigned stretchStep = 16;
/// So many blocks are waited for the end of a contour.
constexpr unsigned longestWait = 2 * RunTrack::longest;
/// In front of so many blocks rules are not asked again: where nothing can be compared, and where
/// they have had something to say.
constexpr unsigned shortPause = 3;
constexpr unsigned longPause = 32;
/// So many blocks that only go on let expect more of them.
constexpr unsigned worthIt = 2;

} // namespace

RunRecorder::RunRecorder(StraightRuns *runs, FileUnit &unit, const Dispatcher &dispatcher,
                         const Collector &collector)
    : runs_(runs), unit_(unit), dispatcher_(dispatcher), collector_(collector),
      whole_(runs ? &runs->straight : nullptr, unit.source.id()),
      stretch_(runs ? &runs->stretches : nullptr, unit.source.id()) {}

const StraightRun *RunRecorder::at(uint32_t offset, MachineState &state, const PlainRun &plain) {
  if (state.modalCalls || state.profile != 0)
    return interrupt();
  const StraightRun *run = whole(offset, state, plain);
  foundWhole_ = run;
  return run ? run : stretch(offset, state, plain);
}

const StraightRun *RunRecorder::whole(uint32_t offset, MachineState &state, const PlainRun &plain) {
  if (whole_.isRecording()) {
    const bool meets = offset == whole_.nextKnown();
    if (whole_.unseen() < step && !meets)
      return nullptr;
    collect(state);
    whole_.memory.clear();
    dispatcher_.remember(whole_.memory);
    // Inside of a contour nothing can be compared: it is waited for its end.
    if (!whole_.memory.isComparable() && whole_.unseen() < longestWait)
      return nullptr;
    if (whole_.mark(offset, state, plain, dispatcher_.gathered()) && !whole_.isFull() && !meets)
      return nullptr;
    whole_.keep();
  }
  if (pause_ > 0 && --pause_ > 0 && !runs_->straight.find(offset))
    return nullptr;
  whole_.memory.clear();
  dispatcher_.remember(whole_.memory);
  if (!whole_.memory.isComparable()) {
    pause_ = shortPause;
    return nullptr;
  }
  if (const StraightRun *run = whole_.find(offset, state, plain)) {
    if (stretch_.isRecording()) {
      collect(state);
      stretch_.mark(offset, state, plain, {});
      stretch_.keep();
    }
    return run;
  }
  collect(state);
  dispatcher_.startGathering();
  whole_.begin(offset, state, plain, collector_.reports());
  return nullptr;
}

const StraightRun *RunRecorder::stretch(uint32_t offset, MachineState &state,
                                        const PlainRun &plain) {
  const auto remember = [&] {
    stretch_.memory.clear();
    dispatcher_.rememberMoves(stretch_.memory);
  };
  if (stretch_.isRecording()) {
    const bool meets = offset == stretch_.nextKnown();
    if (stretch_.unseen() < stretchStep && !meets)
      return nullptr;
    collect(state);
    remember();
    if (stretch_.mark(offset, state, plain, {}) && !stretch_.isFull() && !meets)
      return nullptr;
    stretch_.keep();
  }
  if (streak_ < worthIt)
    return nullptr;
  remember();
  if (!stretch_.memory.isComparable()) {
    streak_ = 0;
    return nullptr;
  }
  if (const StraightRun *run = stretch_.find(offset, state, plain))
    return run;
  collect(state);
  stretch_.begin(offset, state, plain, collector_.reports());
  return nullptr;
}

/// What was done since the last call belongs to what is being recorded.
void RunRecorder::collect(MachineState &state) {
  const FileIndex::Looks looks = unit_.index.takeLooks();
  const CutArea::Box cut = state.cutArea.takeAdded();
  const DepthMoves depth = state.fedFrom.takeMoves();
  whole_.collect(stateUse, looks, cut, depth);
  stretch_.collect(stateUse, looks, cut, depth);
  stateUse = {};
}

bool RunRecorder::takeOver(const StraightRun &run, MachineState &state, PlainRun &plain) {
  if (foundWhole_) {
    if (!dispatcher_.gather(run.gathered))
      return false;
    runs_->taken += run.blocks;
    whole_.takeOver(run, state, plain);
    return true;
  }
  if (whole_.isRecording()) {
    stateUse |= run.use;
    whole_.take(run);
  }
  runs_->taken += run.blocks;
  stretch_.takeOver(run, state, plain);
  return true;
}

void RunRecorder::take(const Block &block, bool goesOn) {
  const bool quiet = block.items.empty() && block.skip < 0;
  const bool clean = isClean(block, *unit_.dialect);
  if (whole_.isRecording()) {
    if (quiet && collector_.reports() == whole_.reports()) {
      whole_.take(block, clean);
    } else {
      pause_ = whole_.isEmpty() ? longPause : 0;
      whole_.keep();
    }
  }
  streak_ = goesOn ? streak_ + 1 : 0;
  if (stretch_.isRecording()) {
    if (goesOn && quiet && collector_.reports() == stretch_.reports())
      stretch_.take(block, clean);
    else
      stretch_.keep();
  }
}

void RunRecorder::end() {
  for (RunTrack *track : {&whole_, &stretch_})
    if (track->isRecording())
      track->keep();
  streak_ = 0;
}

} // namespace ncvet
