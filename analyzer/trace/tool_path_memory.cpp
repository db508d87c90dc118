// The tool path of a program that is being edited.
#include "analyzer/trace/tool_path_memory.h"

#include "analyzer/flow/engine.h"
#include "analyzer/trace/path_lists.h"
#include "analyzer/trace/tool_path_trace.h"

namespace ncvet {

namespace {

/// Blocks between two points: so few that executing them takes some milliseconds, so many that the
/// points of a million blocks take some megabytes.
constexpr uint64_t blocksBetween = 1024;
/// Sets of modes that are no longer used may become so many before all is followed again.
constexpr size_t mostOldSettings = 2000;

/// What rules alone look at, and what grows with each cut, is no part of a point.
MachineState forPath(const MachineState &state) {
  MachineState kept = state;
  kept.cutArea.clear();
  return kept;
}

uint32_t movedBy(uint32_t place, const PathEdit &edit) {
  return place < edit.tail ? place
                           : place + edit.change.added - (edit.change.end - edit.change.begin);
}

bool isNothing(const PathEdit &edit) {
  return edit.change.begin == edit.change.end && edit.change.added == 0;
}

void moveBy(PathPoint &point, const PathEdit &edit) {
  point.next = movedBy(point.next, edit);
  point.rest.sections.next = movedBy(point.rest.sections.next, edit);
  point.text.moveBy(edit);
}

/// Whether some of the text comes after the edit.
bool comesAfter(const ExecutedText &text, const PathEdit &edit) {
  return text.main.end > edit.tail ||
         llvm::any_of(text.programs, [&](const auto &range) { return range.begin >= edit.tail; });
}

/// Adds a program to those that are ordered by their places.
void addProgram(ExecutedText &text, const ProgramInfo &program) {
  const auto at = llvm::partition_point(
      text.programs, [&](const auto &range) { return range.begin < program.begin; });
  if (at == text.programs.end() || at->begin != program.begin)
    text.programs.insert(at, {program.begin, program.end});
}

} // namespace

bool ExecutedText::isClearOf(const PathEdit &edit) const {
  // What is put in at the end of a range may belong to it, and what is put in before it as well.
  const auto isClear = [&](const Range &range) {
    return range.end < edit.change.begin ||
           (range.begin >= edit.tail && range.begin > edit.change.end);
  };
  return isNothing(edit) || (isClear(main) && llvm::all_of(programs, isClear));
}

void ExecutedText::moveBy(const PathEdit &edit) {
  const auto move = [&](Range &range) {
    range = {movedBy(range.begin, edit), movedBy(range.end, edit)};
  };
  move(main);
  llvm::for_each(programs, move);
}

struct ToolPathMemory::Run {
  Project &project;
  FileUnit &unit;
  const AnalysisLimits &limits;
  const std::atomic<bool> *cancel;
  uint64_t piece = 0;  ///< see `ToolPathMemory::follow`
  bool wasCut = false; ///< the path that is there had too many moves
};

/// Keeps points while a program is followed, and finds out when it has come to a known one.
class ToolPathMemory::Marker final : public FlowListener {
public:
  /// `known`: what of an earlier run may be met again, in the order in which it was passed.
  Marker(ToolPathMemory &memory, const Run &run, llvm::ArrayRef<PathPoint> known)
      : memory_(memory), unit_(run.unit), stop_(run.cancel), piece_(run.piece),
        movesBefore_(memory.path_.programmed.moves.size()), wasCut_(run.wasCut), known_(known) {}

  void follow(Tracer &programmed, Tracer *centre, const PathPoint *from) {
    programmed_ = &programmed;
    centre_ = centre;
    if (from) {
      text_.main = {from->next, from->next};
      detours_ = from->detours;
    }
  }

  FlowInterest interest() const override { return {0, false, true, true}; }

  void executed(const Step &step, bool /*continues*/) override {
    ++blocks_;
    ++since_;
    if ((stop_ && *stop_) || memory_.programmed_->cancel)
      cancel = true;
    if (!cancel && isStraight(step))
      pass(step.block.next, step.live.state);
  }

  /// Before the others are told of the block.
  void comesTo(const Step &step) {
    if (!cancel && isOfMain(step) && std::exchange(wasCalled_, false))
      pass(step.block.begin, step.before);
  }

  /// Told of each block before those who follow the path: where calls come one after the other, no
  /// block simply goes on.
  class First final : public FlowListener {
  public:
    explicit First(Marker &marker) : marker_(marker) {}
    FlowInterest interest() const override { return marker_.interest(); }
    void executed(const Step &step, bool /*continues*/) override { marker_.comesTo(step); }

  private:
    Marker &marker_;
  };

  /// The known point to which it has come, as it is now; none: it has run to the end.
  const std::optional<PathPoint> &meeting() const { return meeting_; }
  /// Whether the path goes on there as it is known; else the piece has ended.
  bool isAlike() const { return isAlike_; }
  /// Known points before that one.
  size_t passed() const { return passed_; }
  uint64_t detours() const { return detours_; }
  const ExecutedText &text() const { return text_; }
  uint64_t blocks() const { return blocks_; }
  std::vector<PathPoint> takePoints() { return std::move(points_); }

  std::atomic<bool> cancel = false; ///< there is nothing more to be followed

private:
  bool isOfMain(const Step &step) const {
    const Region &region = step.region();
    return &step.unit() == &unit_ && region.kind == RegionKind::Main && region.depth() == 0;
  }

  /// The main program goes on at `next` in that state.
  void pass(uint32_t next, const MachineState &state) {
    if (!isQuiet(state))
      return;
    text_.main.end = std::max(text_.main.end, next);
    while (!known_.empty() && known_.front().next < next) {
      known_ = known_.drop_front();
      ++passed_;
    }
    const bool isKnown = !turned_ && !known_.empty() && known_.front().next == next;
    if (!isKnown && since_ < blocksBetween)
      return;
    PathPoint point = pointAt(next, state);
    const bool isMet = isKnown && goesOnAlike(known_.front(), point);
    if (isMet || (isKnown && endsPiece(point))) {
      isAlike_ = isMet;
      meeting_.emplace(std::move(point));
      cancel = true;
      memory_.programmed_->close();
      if (memory_.centre_)
        memory_.centre_->close();
    } else if (since_ >= blocksBetween && point.rest.sections.hasCut) {
      since_ = 0;
      text_ = {{next, next}, {}};
      lastProgram_ = nullptr;
      points_.push_back(std::move(point));
    }
  }

  /// Whether the block is one of the main program after which the next one in the text follows.
  bool isStraight(const Step &step) {
    const Flow &flow = step.outcome.flow;
    if (&step.unit() != &unit_) {
      // A return to another block than the one after the call.
      detours_ += flow.kind == FlowKind::Return && flow.target.isConstant();
      return false;
    }
    const Region &region = step.region();
    const bool isMain = isOfMain(step);
    if (isMain) {
      text_.main.begin = std::min(text_.main.begin, step.block.begin);
      text_.main.end = std::max(text_.main.end, step.block.next);
    } else if (std::exchange(lastProgram_, &region.program) != &region.program) {
      addProgram(text_, region.program);
    }
    if (isMain && flow.kind == FlowKind::Next)
      return true;
    switch (flow.kind) {
    case FlowKind::Call:
    case FlowKind::CallNamed:
      wasCalled_ |= isMain;
      break;
    case FlowKind::Next:
    case FlowKind::CallModal:
    case FlowKind::End:
    case FlowKind::Alarm:
      break;
    case FlowKind::Return:
      if (!isMain && !flow.target.isConstant())
        break;
      turned_ = true;
      ++detours_;
      break;
    case FlowKind::LoopBegin:
    case FlowKind::LoopEnd:
    case FlowKind::Structure:
      turned_ |= isMain;
      break;
    default:
      turned_ = true;
      ++detours_;
    }
    return false;
  }

  /// Whether nothing is going on that a point does not hold.
  bool isQuiet(const MachineState &state) const {
    return !state.modalCalls && state.profile == ProfileMode::Off && !state.seeksBranch &&
           programmed_->isIdle() && (!centre_ || centre_->isIdle());
  }

  /// Whether there are enough blocks or moves, and the path can be taken up here.
  bool endsPiece(const PathPoint &point) const {
    const uint64_t moves = memory_.path_.programmed.moves.size() - movesBefore_;
    return piece_ != 0 && std::max(blocks_, moves) >= piece_ && detours_ == 0 &&
           point.rest.sections.hasCut;
  }

  PathPoint pointAt(uint32_t next, const MachineState &state) const {
    PathPoint point{next,
                    forPath(state),
                    programmed_->rest(),
                    std::nullopt,
                    memory_.programmed_->rest(),
                    CurveWriter::nowhere,
                    lengthsOf(memory_.path_),
                    text_,
                    detours_};
    if (centre_) {
      point.centreTrace.emplace(centre_->rest());
      point.centreRest = memory_.centre_->rest();
    }
    return point;
  }

  bool goesOnAlike(const PathPoint &known, const PathPoint &point) const {
    // A path of which the end is missing ends where it has so many moves.
    const auto isAsLong = [](const ListChange &a, const ListChange &b) {
      return a.first == b.first;
    };
    if (wasCut_ && !(isAsLong(known.before.moves, point.before.moves) &&
                     isAsLong(known.before.centre, point.before.centre)))
      return false;
    return equal(known.state, point.state) && programmed_->goesOnAs(known.trace) &&
           bool(known.centreTrace) == bool(centre_) &&
           (!centre_ || (centre_->goesOnAs(*known.centreTrace) &&
                         isSamePoint(known.centreRest, point.centreRest))) &&
           goOnAlike(known.rest, point.rest);
  }

  ToolPathMemory &memory_;
  const FileUnit &unit_;
  const std::atomic<bool> *stop_;
  const uint64_t piece_, movesBefore_;
  const bool wasCut_;
  llvm::ArrayRef<PathPoint> known_;
  Tracer *programmed_ = nullptr, *centre_ = nullptr;
  std::vector<PathPoint> points_;
  std::optional<PathPoint> meeting_;
  uint64_t since_ = 0; ///< blocks since the last point
  uint64_t blocks_ = 0, detours_ = 0;
  size_t passed_ = 0;
  ExecutedText text_;                        ///< since the last point
  const ProgramInfo *lastProgram_ = nullptr; ///< of them that was called
  bool isAlike_ = false;
  bool wasCalled_ = false; ///< by the last block of the main program
  bool turned_ = false;    ///< the program did not go straight on since the run began
};

void ToolPathMemory::clear() {
  points_.clear();
  centre_.reset();
  programmed_.reset();
  files_.reset();
  path_ = {};
  fresh_ = 0;
  whole_ = stale_ = false;
}

/// Whether what was followed last is of use after an edit.
bool ToolPathMemory::mayBeCompared() const {
  return programmed_ && path_.settings.size() <= settingsAtFirst_ + mostOldSettings;
}

/// Whether a run from one of its points ends where one from the start does.
bool ToolPathMemory::mayBeTakenUp() const { return whole_ || path_.end.kind == PathEnd::Cut; }

/// Follows the program from a point, or from its start, and tells the marker.
void ToolPathMemory::runFrom(const Run &run, const PathPoint *from, Marker &marker) {
  Tracer programmed = from ? Tracer(run.project, *programmed_, from->trace)
                           : Tracer(run.project, run.unit, *programmed_, TracedPath::Programmed);
  std::optional<Tracer> centre;
  if (centre_ && from)
    centre.emplace(run.project, *centre_, *from->centreTrace);
  else if (centre_)
    centre.emplace(run.project, run.unit, *centre_, TracedPath::EveryCentre);
  marker.follow(programmed, centre ? &*centre : nullptr, from);
  Engine engine(run.project, run.unit, run.limits, &marker.cancel);
  Marker::First first(marker);
  engine.listen(first);
  engine.listen(programmed);
  if (centre)
    engine.listen(*centre);
  engine.listen(marker);
  if (from)
    engine.followFrom(from->next, from->state);
  else
    engine.follow();
  programmed.finish();
  if (centre)
    centre->finish();
  executed_ = marker.blocks();
  whole_ = engine.isComplete() || marker.meeting();
}

std::optional<ToolPathChange> ToolPathMemory::followAll(const Run &run, bool withCentre) {
  clear();
  const Dialect &dialect = run.project.dialect();
  path_.lathe = dialect.isLathe();
  path_.diameter = dialect.lengthsPerUnit(Axis::X) == 2;
  path_.machine = pathMachine(run.unit.machine, dialect);
  files_.emplace(run.project.sources());
  files_->of(run.unit.source.id());
  programmed_.emplace(dialect, path_, *files_, most_);
  start_ = programmed_->rest();
  if (withCentre)
    centre_.emplace(dialect, path_, *files_, most_);
  Marker marker(*this, run, {});
  runFrom(run, nullptr, marker);
  if (run.cancel && *run.cancel) {
    clear();
    return std::nullopt;
  }
  if (!withCentre && programmed_->hasCentre())
    return followAll(run, true);
  points_ = marker.takePoints();
  fresh_ = points_.size();
  text_ = marker.text();
  detours_ = marker.detours();
  settingsAtFirst_ = path_.settings.size();
  return ToolPathChange();
}

/// Takes the points away that the edit may have made wrong: what is left was passed before it.
/// Gives those after which the program does not come by it again, and how many of these are fresh.
std::vector<PathPoint> ToolPathMemory::takeAfter(const PathEdit &edit, size_t &fresh) {
  size_t kept = 0;
  while (kept < fresh_ && points_[kept].detours == 0 && points_[kept].text.isClearOf(edit))
    ++kept;
  size_t tail = points_.size();
  const ExecutedText *text = &text_;
  while (tail > kept && text->isClearOf(edit) && points_[tail - 1].detours == detours_)
    text = &points_[--tail].text;
  std::vector<PathPoint> after(std::make_move_iterator(points_.begin() + ptrdiff_t(tail)),
                               std::make_move_iterator(points_.end()));
  fresh = fresh_ > tail ? fresh_ - tail : 0;
  while (points_.size() > kept)
    points_.pop_back();
  return after;
}

/// Known points of an earlier run are points of this one, too, which has come to the first of them
/// in the same state, or (`isAlike` false) only to its place: then that one is left out.
void ToolPathMemory::takeOver(llvm::MutableArrayRef<PathPoint> known, const PathPoint &met,
                              bool isAlike) {
  const ToolPathChange old = known.front().before, &now = met.before;
  const uint64_t detours = met.detours - known.front().detours;
  for (PathPoint &point : known) {
    const auto move = [](ListChange &list, const ListChange &from, const ListChange &to) {
      list.first += to.first - from.first;
    };
    move(point.before.moves, old.moves, now.moves);
    move(point.before.centre, old.centre, now.centre);
    move(point.before.feeds, old.feeds, now.feeds);
    move(point.before.dwells, old.dwells, now.dwells);
    move(point.before.others, old.others, now.others);
    move(point.before.sections, old.sections, now.sections);
    move(point.before.operations, old.operations, now.operations);
    point.rest.sections.operations += now.operations.first - old.operations.first;
    point.detours += detours;
  }
  known.front().text = met.text;
  for (PathPoint &point : known.drop_front(isAlike ? 0 : 1))
    points_.push_back(std::move(point));
  detours_ += detours;
}

/// The run has come to one of the known points, of which the first ones are fresh.
void ToolPathMemory::meet(const Marker &marker, llvm::MutableArrayRef<PathPoint> known,
                          size_t fresh) {
  const size_t passed = marker.passed();
  if (!marker.isAlike()) {
    points_.push_back(*marker.meeting());
    fresh_ = points_.size();
    stale_ = true;
    takeOver(known.drop_front(passed), *marker.meeting(), false);
    return;
  }
  stale_ &= passed < fresh;
  const size_t freshNow = points_.size() + fresh - passed;
  takeOver(known.drop_front(passed), *marker.meeting(), true);
  fresh_ = stale_ ? freshNow : points_.size();
}

std::optional<ToolPathChange> ToolPathMemory::followEdit(const Run &run, const PathEdit &edit) {
  files_->use(run.project.sources());
  files_->of(run.unit.source.id());
  size_t freshAfter = 0;
  std::vector<PathPoint> after = takeAfter(edit, freshAfter);
  const bool movesLines = edit.lines != 0 && llvm::any_of(points_, [&](const PathPoint &point) {
                            return comesAfter(point.text, edit);
                          });
  for (PathPoint &point : points_)
    moveBy(point, edit);
  for (PathPoint &point : after)
    moveBy(point, edit);
  text_.moveBy(edit);
  const PathPoint *const from = points_.empty() ? nullptr : &points_.back();
  ToolPathChange change = from ? from->before : ToolPathChange();
  change.whole = false;
  change.settings = uint32_t(path_.settings.size());
  change.line = edit.line;
  change.lines = edit.lines;
  CutPath old(path_, change);
  if (movesLines)
    moveLines(path_, change);
  programmed_->resume(from ? from->rest : start_);
  if (centre_)
    centre_->resume(from ? from->centreRest : CurveWriter::nowhere);
  Marker marker(*this, run, after);
  runFrom(run, from, marker);
  if (run.cancel && *run.cancel) {
    clear();
    return std::nullopt;
  }
  if (!centre_ && programmed_->hasCentre())
    return followAll(run, true);
  for (PathPoint &point : marker.takePoints())
    points_.push_back(std::move(point));
  if (marker.meeting()) {
    const auto known = llvm::makeMutableArrayRef(after.data(), after.size());
    old.append(after[marker.passed()].before, change);
    meet(marker, known, freshAfter);
  } else {
    text_ = marker.text();
    detours_ = marker.detours();
    stale_ = false;
    fresh_ = points_.size();
    old.compare(change);
  }
  return change;
}

std::optional<ToolPathChange>
ToolPathMemory::follow(Project &project, FileUnit &unit, const AnalysisLimits &limits,
                       const PathEdit *edit, const std::atomic<bool> *cancel, uint64_t piece) {
  const bool wasCut = path_.end.kind == PathEnd::Cut;
  const Run run{project, unit, limits, cancel, wasCut ? 0 : piece, wasCut};
  if (!edit || !mayBeCompared() || dialect_ != unit.dialect) {
    const bool withCentre = centre_ && dialect_ == unit.dialect;
    dialect_ = unit.dialect;
    return followAll(run, withCentre);
  }
  if (!mayBeTakenUp()) {
    points_.clear();
    fresh_ = 0;
    stale_ = false;
  }
  return followEdit(run, *edit);
}

} // namespace ncvet
