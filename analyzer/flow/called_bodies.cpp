// Runs called bodies, and remembers what each did for which state.
#include "analyzer/flow/called_bodies.h"

#include "formats/dialect/control_facts.h"
#include "interp/state/equal_but_cut.h"
#include "interp/value/work_meter.h"

namespace ncvet {

namespace {

/// After so many runs none of which was like one that is remembered, only one of so many is
/// compared with them: a macro in a loop is called with other numbers each time.
constexpr unsigned mostInVain = 256, lookedAtThen = 16;
/// What a called body costs besides its blocks, in plain moves: states are copied and compared.
constexpr uint64_t workOfCall = 16;
/// What it costs to find and to copy what a body did before.
constexpr uint64_t workOfRecall = 4;

} // namespace

/// What is known of bodies: of those that other runs have followed as well, where whoever calls
/// this program is not known, and what they have called tells nothing of its file.
BodyMemos &CalledBodies::memos() {
  if (memos_)
    return *memos_;
  const FileIndex &index = run_.unit.index;
  const bool shares = run_.outer && run_.outer->bodies && run_.entryUnknown && !calls_ &&
                      index.programs().size() == 1 && index.subprograms().empty() &&
                      !run_.outer->bodies->isAbandoned();
  memos_ = shares ? run_.outer->bodies.get() : &own_;
  memos_->begin(run_.unit.dialect);
  if (shares)
    mainFile_ = memos_->numberOf(run_.unit.source.path());
  return *memos_;
}

/// A run of the body that did what a run now would do; null: there is none.
const BodyMemos::Memo *CalledBodies::find(const Region &region, const Remembered &body,
                                          uint64_t sum, unsigned sections, const Live &live) const {
  const Dialect &dialect = *region.unit.dialect;
  const unsigned depth = region.depth();
  for (const Memo &memo : body.memos)
    if (memo.holdsFor(sum, live.state) && sections <= memo.sections &&
        !memo.goesTooDeep(depth, dialect.limits.callDepth) &&
        !memo.goesTooDeep(depth, dialect.facts->limits.macroDepth) &&
        (memo.run == memos_->run() || mainFile_ >= memo.effect.files.size() ||
         !memo.effect.files.test(mainFile_)))
      return &memo;
  return nullptr;
}

/// What the body did for the same state before.
std::optional<Exits> CalledBodies::recall(const Region &region, Remembered &body, uint64_t sum,
                                          unsigned sections, const Live &live) {
  run_.repeated += workOfRecall;
  const Memo *const memo = find(region, body, sum, sections, live);
  if (!memo)
    return std::nullopt;
  body.inVain = 0;
  Exits exits = memo->exits;
  const Effect &effect = memo->effect;
  run_.stops += effect.stops;
  run_.forks += effect.forks;
  run_.deepest = std::max(run_.deepest, region.depth() + effect.levels);
  run_.restsOnOthers |= memo->run != memos_->run();
  stateUse |= effect.use;
  noteFiles(effect.files);
  for (size_t i = 0; i < exits.size(); ++i) {
    exits[i].live.path = live.path;
    exits[i].live.decided = live.decided;
    memo->leadOn(live.state, i, exits[i].live.state);
  }
  const unsigned allowed = region.unit.dialect->limits.callDepth;
  const bool tells = allowed && region.depth() + effect.levels > allowed;
  if (calls_ && effect.texts && !tells && body.hasRoom())
    calls_->noteRecalled(bodyRunOf(region, memo->print), *effect.texts);
  else if (calls_)
    calls_->spoil();
  return exits;
}

void CalledBodies::noteFiles(const llvm::BitVector &more) {
  if (isShared())
    files_ |= more;
}

bool CalledBodies::isWorthLooking(Remembered &body) {
  return body.hasRoom() || ++body.inVain <= mostInVain || body.inVain % lookedAtThen == 0;
}

/// Paths that return to the same place in the same modes are one, and go on along `path`, which has
/// decided what `decided` says.
Exits CalledBodies::merge(Exits raw, const PathNode *path, const DecidedCondition *decided) {
  if (raw.size() == 1) {
    ++workDone; // as `mergeInto` counts it
    raw.front().live.path = path;
    raw.front().live.decided = decided;
    return raw;
  }
  std::map<int64_t, Lives> byTarget;
  for (Returned &exit : raw) {
    exit.live.path = path;
    exit.live.decided = decided;
    mergeInto(byTarget[exit.target], std::move(exit.live));
  }
  Exits exits;
  for (auto &[target, group] : byTarget)
    for (Live &exit : group)
      exits.push_back({std::move(exit), target});
  return exits;
}

RunningRegion CalledBodies::keyOfInner(const BodyRun &body) const {
  return {run_.unit.source.id(), body.start, RegionKind(body.kind), body.end};
}

/// Whether all that ran in the call would run in it now: nothing else has run for such states, and
/// it can be remembered that they have. What was known from before has run now as well.
bool CalledBodies::mayTakeOver(const KnownCall &call) {
  const FileId file = run_.unit.source.id();
  return llvm::none_of(call.texts,
                       [&](const auto &text) {
                         return run_.listeners.mustSee(file, text.first, text.second);
                       }) &&
         llvm::all_of(call.inner,
                      [&](const BodyRun &inner) {
                        return memos().of(keyOfInner(inner)).hasRoom() &&
                               !ran_.count(inner.print());
                      }) &&
         llvm::all_of(call.recalled, [&](const BodyRun &body) { return ran_.count(body.print()); });
}

void CalledBodies::noteRun(const KnownCall &call) {
  for (const BodyRun &inner : call.inner) {
    ++memos().of(keyOfInner(inner)).known;
    ran_.insert(inner.print());
    known_.insert(inner.print());
  }
}

/// `effect`: what is to be known of it the next time.
Exits CalledBodies::runAnew(const Region &region, Live live, Effect &effect) {
  run_.repeated += workOfCall;
  run_.callStack.push_back(keyOf(region));
  const PathNode *path = live.path;
  // A body does the same for each of its callers, whatever these have decided.
  const DecidedCondition *const decided = std::exchange(live.decided, nullptr);
  MachineState &state = live.state;
  const StateUse usedBefore = std::exchange(stateUse, StateUse());
  const CutArea::Box cutBefore = state.cutArea.takeAdded();
  const DepthMoves depthBefore = state.fedFrom.takeMoves();
  const std::optional<size_t> texts =
      calls_ && calls_->isRecording() ? std::optional(calls_->startTexts()) : std::nullopt;
  Lives lives;
  lives.push_back(std::move(live));
  Exits exits = merge(run_.execute(region, std::move(lives)), path, decided);
  run_.callStack.pop_back();
  effect.use = std::exchange(stateUse, usedBefore);
  stateUse |= effect.use;
  if (texts)
    effect.texts = calls_->textsSince(*texts);
  for (Returned &exit : exits) {
    MachineState &left = exit.live.state;
    const BodyMemos::Added added{left.cutArea.takeAdded(), left.fedFrom.takeMoves()};
    left.cutArea.add(added.cut);
    if (!effect.use.has(StatePart::CutArea))
      left.cutArea.add(cutBefore);
    left.fedFrom.add(added.depth);
    left.fedFrom.add(depthBefore);
    effect.added.push_back(added);
  }
  return exits;
}

/// The same of a body that a call has run that was taken over: everybody knows of it, but what it
/// did was not kept.
Exits CalledBodies::runMuted(const Region &region, Live live, Effect &effect) {
  const Listeners listeners = std::exchange(run_.listeners, Listeners());
  const bool muted = std::exchange(muted_, true), abstract = run_.abstract;
  const uint64_t repeated = run_.repeated, steps = run_.steps, work = workDone;
  const unsigned stops = run_.stops, forks = run_.forks;
  Exits exits = runAnew(region, std::move(live), effect);
  effect.stops = run_.stops != stops;
  effect.forks = run_.forks != forks;
  run_.listeners = listeners;
  muted_ = muted;
  run_.repeated = repeated;
  run_.steps = steps;
  workDone = work;
  run_.stops = stops + effect.stops;
  run_.forks = forks + effect.forks;
  if (run_.abstract != abstract || run_.stopped)
    run_.stale = run_.stopped = true;
  return exits;
}

/// The same, where an earlier analysis may know it.
Exits CalledBodies::runOrTakeOver(const Region &region, Live live, const BodyRun &body,
                                  bool isRemembered, Effect &effect) {
  const uint64_t print = body.print();
  if (isRemembered && known_.erase(print)) {
    --memos().of(region).known;
    Exits exits = runMuted(region, std::move(live), effect);
    calls_->noteRecalled(body, {});
    return exits;
  }
  if (!isRemembered || muted_)
    calls_->spoil();
  const bool isOutermost = isRemembered && calls_->mayReuse(region, live);
  if (isOutermost) {
    const auto may = [&](const KnownCall &call) { return mayTakeOver(call); };
    if (const KnownCall *known = calls_->takeOver(region, live, may)) {
      noteRun(*known);
      ran_.insert(print);
      effect.use = known->run.use;
      effect.added.push_back({known->run.cut, known->run.depth});
      Exits exits;
      exits.push_back({std::move(live)});
      return exits;
    }
    calls_->begin(region, live, body);
  } else if (isRemembered) {
    calls_->noteInner(body);
  }
  Exits exits = runAnew(region, std::move(live), effect);
  if (isOutermost)
    calls_->end(exits);
  if (isRemembered && !run_.stopped)
    ran_.insert(print);
  return exits;
}

Exits CalledBodies::run(const Region &region, Live live) {
  Remembered &body = memos().of(region);
  body.makeRoom(memos_->run());
  const bool looks = !run_.listeners.followOnePath() && isWorthLooking(body);
  const uint64_t sum = looks ? hashButCut(live.state) : 0;
  // Deeper inside repeated sections than before, one more level may be one too many.
  const unsigned sections = region.kind == RegionKind::Section ? runningSections() : 0;
  if (looks)
    if (auto known = recall(region, body, sum, sections, live))
      return std::move(*known);
  const bool isRemembered = looks && body.hasRoom();
  const uint64_t print = looks && calls_ ? hash(live.state) : 0;
  std::optional<MachineState> entry;
  if (isRemembered)
    entry = live.state;
  Effect effect;
  const unsigned stops = run_.stops, forks = run_.forks;
  const unsigned deepest = std::exchange(run_.deepest, region.depth());
  llvm::BitVector files = std::exchange(files_, llvm::BitVector());
  Exits exits = calls_ ? runOrTakeOver(region, std::move(live), bodyRunOf(region, print),
                                       isRemembered, effect)
                       : runAnew(region, std::move(live), effect);
  effect.levels = run_.deepest - region.depth();
  run_.deepest = std::max(run_.deepest, deepest);
  if (isShared()) {
    const unsigned file = memos_->numberOf(region.unit.source.path());
    files_.resize(std::max(files_.size(), file + 1));
    files_.set(file);
    effect.files = files_;
    files_ |= files;
  }
  if (isRemembered && !run_.stopped && !(isShared() && run_.abstract)) {
    effect.stops = run_.stops != stops;
    effect.forks = run_.forks != forks;
    body.add({sum, print, std::move(*entry), exits, sections, region.depth(), memos_->run(),
              std::move(effect)});
  }
  return exits;
}

unsigned CalledBodies::runningSections() const {
  return unsigned(llvm::count_if(run_.callStack, [](const RunningRegion &running) {
    return std::get<RegionKind>(running) == RegionKind::Section;
  }));
}

} // namespace ncvet
