// Records runs of plain blocks: where one begins and ends, and when it can be taken over.
#include "analyzer/reuse/run_recorder.h"

namespace ncvet {

namespace {

/// After so many blocks it is seen whether they still are a run; of a run that is long already,
/// after more of them.
constexpr unsigned step = 32, longStep = 64;
/// The same of blocks that only go on: where they end is seen in any case.
constexpr unsigned stretchStep = 64;
/// So many blocks are waited for the end of a contour, in which nothing can be compared, or in
/// which rules remember what they forget there; and so often it is looked for.
constexpr unsigned longestWait = 2 * longestRun, shortWait = 2 * step, look = 4;
/// Before so many blocks rules are not asked again: where nothing can be compared, and where
/// they have had something to say.
constexpr unsigned shortPause = 3;
constexpr unsigned longPause = 32;
/// So many blocks that only go on let expect more of them.
constexpr unsigned worthIt = 2;

} // namespace

RunRecorder::RunRecorder(StraightRuns &runs, FileUnit &unit, const Dispatcher &dispatcher,
                         const Collector &collector)
    : runs_(runs), unit_(unit), dispatcher_(dispatcher), collector_(collector),
      whole_(&runs.straight), stretch_(&runs.stretches), chains_(&runs), memory_(unit.source.id()),
      moves_(unit.source.id()) {}

std::optional<RunPlace> RunRecorder::takeOver(uint32_t offset, MachineState &state, PlainRun &plain,
                                              May may) {
  if (offset < executedEnd_)
    return std::nullopt;
  if (state.modalCalls || state.profile != ProfileMode::Off) {
    interrupt();
    return std::nullopt;
  }
  auto place = takeWhole(offset, state, plain, may);
  if (!place && offset >= executedEnd_)
    place = takeStretch(offset, state, plain, may);
  if (place) {
    runs_.taken.blocks += place->blocks;
    ++runs_.taken.runs;
  } else if (stretch_.isRecording()) {
    before_ = {offset, stateUse, unit_.index.looks(), plain};
  }
  return place;
}

/// Ends the run that is being recorded where it is time. Whether the next one may begin here, with
/// what `memory_` says then.
bool RunRecorder::mayBegin(uint32_t offset, MachineState &state, const PlainRun &plain) {
  const auto remember = [&] {
    memory_.clear();
    dispatcher_.remember(memory_);
  };
  if (whole_.isRecording()) {
    const bool meets = offset == whole_.nextKnown();
    const uint64_t unseen = whole_.unseen();
    if ((unseen < wholeStep() || unseen % look != 0) && !meets)
      return false;
    collect(state);
    remember();
    uint64_t wait = 0;
    if (!memory_.isComparable())
      wait = longestWait;
    else if (!meets && !whole_.mayEnd(memory_))
      wait = shortWait;
    if (unseen < wait)
      return false;
    if (whole_.mark(offset, state, plain, memory_, dispatcher_.gathered()) && !whole_.isFull() &&
        !meets)
      return false;
    whole_.keep();
  }
  if (pause_ > 0 && --pause_ > 0 && !chains_.isRecording() && !runs_.straight.find(offset))
    return false;
  remember();
  if (!memory_.isComparable()) {
    chains_.drop();
    pause_ = shortPause;
    return false;
  }
  return true;
}

std::optional<RunPlace> RunRecorder::takeWhole(uint32_t offset, MachineState &state,
                                               PlainRun &plain, May may) {
  if (!mayBegin(offset, state, plain))
    return std::nullopt;
  for (size_t level = RunChains::levels; level > 0; --level) {
    const StraightRun *chain = chains_.find(level, offset, state, plain, memory_);
    if (!chain || !may(*chain))
      continue;
    const RunPlace place = *chain;
    finishStretch(offset, state, plain);
    chains_.take(level, *chain, state, plain, memory_);
    chains_.takeOver(level, *chain, state, plain, memory_);
    return place;
  }
  if (const StraightRun *run = whole_.find(offset, state, plain, memory_)) {
    const RunPlace place = *run;
    finishStretch(offset, state, plain);
    if (may(place) && dispatcher_.gather(run->gathered)) {
      chains_.take(0, *run, state, plain, memory_);
      whole_.takeOver(*run, state, plain, memory_);
      return place;
    }
    chains_.end(offset, state, plain, memory_);
    executedEnd_ = place.end;
    return std::nullopt;
  }
  chains_.end(offset, state, plain, memory_);
  collect(state);
  dispatcher_.startGathering();
  whole_.begin(offset, state, plain, memory_, collector_.reports());
  return std::nullopt;
}

/// A whole run follows: what was recorded up to here is a stretch.
void RunRecorder::finishStretch(uint32_t offset, MachineState &state, const PlainRun &plain) {
  if (!stretch_.isRecording())
    return;
  collect(state);
  rememberMoves();
  stretch_.mark(offset, state, plain, moves_, {});
  stretch_.keep();
}

void RunRecorder::endStretchBefore(MachineState &before) {
  if (stretch_.unseen() > 0 && collector_.reports() == stretch_.reports()) {
    // What the whole run has used is collected with it.
    stretch_.collect(before_.use, before_.looks, before.cutArea.takeAdded(),
                     before.fedFrom.takeMoves());
    rememberMoves();
    stretch_.mark(before_.offset, before, before_.plain, moves_, {});
  }
  stretch_.keep();
}

void RunRecorder::rememberMoves() {
  moves_.clear();
  dispatcher_.rememberMoves(moves_);
}

std::optional<RunPlace> RunRecorder::takeStretch(uint32_t offset, MachineState &state,
                                                 PlainRun &plain, May may) {
  if (stretch_.isRecording()) {
    const bool meets = offset == stretch_.nextKnown();
    if (stretch_.unseen() < stretchStep && !meets)
      return std::nullopt;
    collect(state);
    rememberMoves();
    if (stretch_.mark(offset, state, plain, moves_, {}) && !stretch_.isFull() && !meets)
      return std::nullopt;
    stretch_.keep();
  }
  if (streak_ < worthIt)
    return std::nullopt;
  rememberMoves();
  if (!moves_.isComparable()) {
    streak_ = 0;
    return std::nullopt;
  }
  if (const StraightRun *run = stretch_.find(offset, state, plain, moves_)) {
    const RunPlace place = *run;
    if (!may(place)) {
      executedEnd_ = place.end;
      return std::nullopt;
    }
    if (whole_.isRecording())
      whole_.take(*run);
    stretch_.takeOver(*run, state, plain, moves_);
    return place;
  }
  collect(state);
  stretch_.begin(offset, state, plain, moves_, collector_.reports());
  return std::nullopt;
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

void RunRecorder::executed(const Block &block, bool goesOn) {
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

unsigned RunRecorder::wholeStep() const { return whole_.seen() < longStep ? step : longStep; }

RunRecorder::Unasked RunRecorder::unasked(uint32_t offset) const {
  if (!whole_.isRecording() || !stretch_.isRecording() || offset < executedEnd_)
    return {};
  const uint64_t whole = whole_.unseen(), stretch = stretch_.unseen();
  if (stretch >= stretchStep || (whole >= wholeStep() && whole % look == 0))
    return {};
  const uint64_t left = whole < wholeStep() ? wholeStep() - whole : look - whole % look;
  return {std::min(left, stretchStep - stretch),
          std::min(whole_.nextKnown(), stretch_.nextKnown())};
}

void RunRecorder::executedUnasked(std::pair<uint32_t, uint32_t> last, uint64_t blocks) {
  whole_.take(last, blocks);
  stretch_.take(last, blocks);
  streak_ += unsigned(blocks);
}

void RunRecorder::interrupt() {
  for (RunTrack *track : {&whole_, &stretch_})
    if (track->isRecording())
      track->keep();
  chains_.drop();
  streak_ = 0;
}

} // namespace ncvet
