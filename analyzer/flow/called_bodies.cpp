// Runs called bodies, and remembers what each did for which state.
#include "analyzer/flow/called_bodies.h"

#include "interp/value/work_meter.h"

namespace ncvet {

namespace {

/// Results of one called program that are remembered.
constexpr size_t memosPerProgram = 64;
/// After so many runs none of which was like one that is remembered, only one of so many is
/// compared with them: a macro in a loop is called with other numbers each time.
constexpr unsigned mostInVain = 256, lookedAtThen = 16;
/// What a called body costs besides its blocks, in plain moves: states are copied and compared.
constexpr uint64_t workOfCall = 16;
/// What it costs to find and to copy what a body did before.
constexpr uint64_t workOfRecall = 4;

} // namespace

/// Where things were set that the body neither looks at nor sets is where that was on the way here.
static void keepOrigins(const StateUse &use, const MachineState &here, MachineState &left) {
  const OriginState::Places &before = here.origin.all();
  OriginState::Places &after = left.origin.all();
  for (size_t i = 0; i < after.size(); ++i) {
    const bool isGroup = i < maxGroups;
    const uint64_t used = isGroup ? use.groupOrigins : use.otherOrigins;
    if (!(used >> (isGroup ? i : i - maxGroups) & 1))
      after[i] = before[i];
  }
}

/// What the body did for the same state before.
std::optional<Exits> CalledBodies::recall(const Region &region, Remembered &body, uint64_t print,
                                          unsigned sections, const Live &live) {
  run_.repeated += workOfRecall;
  for (const Memo &memo : body.memos) {
    if (memo.hash != print || sections > memo.sections || !equal(memo.entry, live.state))
      continue;
    body.inVain = 0;
    Exits exits = memo.exits;
    run_.stops += memo.effect.stops;
    run_.forks += memo.effect.forks;
    stateUse |= memo.effect.use;
    for (size_t i = 0; i < exits.size(); ++i) {
      exits[i].live.path = live.path;
      MachineState &left = exits[i].live.state;
      keepOrigins(memo.effect.use, live.state, left);
      if (!calls_)
        continue;
      if (!memo.effect.use.has(StatePart::CutArea)) {
        left.cutArea = live.state->cutArea;
        left.cutArea.add(memo.effect.added[i].cut);
      }
      const Interval level = left.fedFrom.peek();
      left.fedFrom = live.state->fedFrom;
      left.fedFrom.add(memo.effect.added[i].depth);
      left.fedFrom.peek() = level;
    }
    if (calls_ && memo.effect.texts && hasRoom(body))
      calls_->noteRecalled(bodyRunOf(region, print), *memo.effect.texts);
    else if (calls_)
      calls_->spoil();
    return exits;
  }
  return std::nullopt;
}

bool CalledBodies::hasRoom(const Remembered &body) {
  return body.memos.size() + body.known < memosPerProgram;
}

bool CalledBodies::isWorthLooking(Remembered &body) {
  return hasRoom(body) || ++body.inVain <= mostInVain || body.inVain % lookedAtThen == 0;
}

/// Paths that return to the same place in the same modes are one, and go on along `path`.
Exits CalledBodies::merge(Exits raw, const PathNode *path) {
  if (raw.size() == 1) {
    ++workDone; // as `mergeInto` counts it
    raw.front().live.path = path;
    return raw;
  }
  std::map<int64_t, Lives> byTarget;
  for (Returned &exit : raw) {
    exit.live.path = path;
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
                        return hasRoom(remembered_[keyOfInner(inner)]) &&
                               !ran_.count(inner.print());
                      }) &&
         llvm::all_of(call.recalled, [&](const BodyRun &body) { return ran_.count(body.print()); });
}

void CalledBodies::noteRun(const KnownCall &call) {
  for (const BodyRun &inner : call.inner) {
    ++remembered_[keyOfInner(inner)].known;
    ran_.insert(inner.print());
    known_.insert(inner.print());
  }
}

/// `effect`: what is to be known of it the next time.
Exits CalledBodies::runAnew(const Region &region, Live live, Effect &effect) {
  run_.repeated += workOfCall;
  run_.callStack.push_back(keyOf(region));
  const PathNode *path = live.path;
  MachineState &state = live.state;
  const StateUse usedBefore = std::exchange(stateUse, StateUse());
  const CutArea::Box cutBefore = calls_ ? state.cutArea.takeAdded() : CutArea::none;
  const DepthMoves depthBefore = calls_ ? state.fedFrom.takeMoves() : DepthMoves();
  const std::optional<size_t> texts =
      calls_ && calls_->isRecording() ? std::optional(calls_->startTexts()) : std::nullopt;
  Lives lives;
  lives.push_back(std::move(live));
  Exits exits = merge(run_.execute(region, std::move(lives)), path);
  run_.callStack.pop_back();
  effect.use = std::exchange(stateUse, usedBefore);
  stateUse |= effect.use;
  if (texts)
    effect.texts = calls_->textsSince(*texts);
  for (size_t i = 0; calls_ && i < exits.size(); ++i) {
    MachineState &left = exits[i].live.state;
    const Added added{left.cutArea.takeAdded(), left.fedFrom.takeMoves()};
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
    --remembered_[keyOf(region)].known;
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
  Remembered &body = remembered_[keyOf(region)];
  const bool looks = !run_.listeners.followOnePath() && isWorthLooking(body);
  const uint64_t print = looks ? hash(live.state) : 0;
  // Deeper inside repeated sections than before, one more level may be one too many.
  const unsigned sections = region.kind == RegionKind::Section ? runningSections() : 0;
  if (looks)
    if (auto known = recall(region, body, print, sections, live))
      return std::move(*known);
  const bool isRemembered = looks && hasRoom(body);
  std::optional<MachineState> entry;
  if (isRemembered)
    entry = live.state;
  Effect effect;
  const unsigned stops = run_.stops, forks = run_.forks;
  Exits exits = calls_ ? runOrTakeOver(region, std::move(live), bodyRunOf(region, print),
                                       isRemembered, effect)
                       : runAnew(region, std::move(live), effect);
  if (isRemembered && !run_.stopped && hasRoom(body)) {
    effect.stops = run_.stops != stops;
    effect.forks = run_.forks != forks;
    body.memos.push_back({print, std::move(*entry), exits, sections, std::move(effect)});
  }
  return exits;
}

unsigned CalledBodies::runningSections() const {
  return unsigned(llvm::count_if(run_.callStack, [](const RunningRegion &running) {
    return std::get<RegionKind>(running) == RegionKind::Section;
  }));
}

} // namespace ncvet
