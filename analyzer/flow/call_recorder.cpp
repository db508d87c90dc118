// Takes over what called programs did in an earlier analysis, and records what they do.
#include "analyzer/flow/call_recorder.h"

#include "interp/value/work_meter.h"

#include <algorithm>

namespace ncvet {

namespace {

/// What is called reads so many places apart from each other at most.
constexpr size_t mostTexts = 256;

/// The switches of all levels as one number.
uint64_t numberOf(const SkipSwitches &skip) {
  uint64_t number = 0;
  for (const SkipSwitch one : skip)
    number = number << 2 | uint64_t(one);
  return number;
}

/// Each once, in order; what meets is one.
void sortPlaces(std::vector<KnownCall::Text> &places) {
  llvm::erase_if(places, [](const KnownCall::Text &text) { return text.second == 0; });
  llvm::sort(places);
  size_t kept = 0;
  for (const auto &place : places)
    if (kept && place.first <= places[kept - 1].second)
      places[kept - 1].second = std::max(places[kept - 1].second, place.second);
    else
      places[kept++] = place;
  places.resize(kept);
}

template <typename T>
std::vector<T> once(std::vector<T> list) {
  llvm::sort(list);
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

} // namespace

BodyRun bodyRunOf(const Region &region, uint64_t state) {
  const auto [file, start, kind, end] = keyOf(region);
  return {start, end, unsigned(kind), state};
}

bool CallRecorder::mayReuse(const Region &region, const Live &live) const {
  const bool isProgram =
      region.kind == RegionKind::Subprogram || region.kind == RegionKind::LocalSubprogram;
  const MachineState &state = live.state;
  return isProgram && run_.callStack.empty() && !call_ && region.depth() == 1 &&
         &region.unit == &run_.unit && region.caller->unit == &run_.unit && !run_.entryUnknown &&
         !run_.callerUnknown && !run_.outer && !run_.abstract && !run_.inFull && !run_.stopped &&
         !run_.listeners.followOnePath() && !state.modalCalls && state.profile == ProfileMode::Off;
}

void CallRecorder::noteRecalled(const BodyRun &body, llvm::ArrayRef<KnownCall::Text> texts) {
  if (!call_)
    return;
  const uint64_t print = body.print();
  for (const auto *bodies : {&call_->inner, &call_->recalled})
    if (llvm::any_of(*bodies, [&](const BodyRun &known) { return known.print() == print; }))
      return;
  call_->recalled.push_back(body);
  call_->texts.insert(call_->texts.end(), texts.begin(), texts.end());
}

size_t CallRecorder::startTexts() {
  call_->texts.emplace_back(0, 0); // what follows is no part of a place before it
  return call_->texts.size();
}

std::vector<KnownCall::Text> CallRecorder::textsSince(size_t start) const {
  std::vector<KnownCall::Text> texts(call_->texts.begin() + ptrdiff_t(start), call_->texts.end());
  sortPlaces(texts);
  return texts;
}

bool CallRecorder::fits(const KnownCall &call, const Region &region, const Live &live,
                        const RuleMemory &memory) const {
  const CallSite &caller = *region.caller;
  return call.body.kind == unsigned(region.kind) && call.once == caller.once &&
         call.macro == caller.macro && call.skip == numberOf(live.skip) &&
         run_.repeated + call.repeated + workDone <= run_.limits.repeatedBlocks &&
         call.run.begins(live.state, PlainRun(), memory);
}

const KnownCall *CallRecorder::takeOver(const Region &region, Live &live,
                                        llvm::function_ref<bool(const KnownCall &)> may) {
  std::optional<RuleMemory> memory;
  const KnownCall *const known =
      runs_.calls.find(region.start, region.caller->next, [&](const KnownCall &call) {
        if (!memory)
          rules_.dispatcher().remember(memory.emplace(region.unit.source.id()));
        return fits(call, region, live, *memory) && may(call);
      });
  if (!known || !rules_.dispatcher().gather(known->run.gathered))
    return nullptr;
  apply(*known, live);
  return known;
}

void CallRecorder::apply(const KnownCall &call, Live &live) {
  MachineState state = live.state;
  PlainRun plain;
  call.run.carry(state, plain);
  live.state = state;
  run_.repeated += call.repeated;
  if (workDone > call.workBefore)
    run_.repeated += workDone - call.workBefore;
  workDone = call.workAfter;
  run_.steps += call.steps;
  run_.stops += call.stops;
  run_.forks += call.forks;
  const auto use = [](auto &all, const auto &those) {
    for (const auto &one : those)
      all.insert(one);
  };
  use(run_.used.numbers, call.numbers);
  use(run_.used.programs, call.programs);
  use(run_.used.labels, call.labels);
  use(run_.used.names, call.names);
  for (const auto &[begin, end] : call.covered)
    run_.covered.add(begin, end);
  runs_.taken.blocks += call.steps;
  ++runs_.taken.runs;
}

void CallRecorder::begin(const Region &region, Live &live, const BodyRun &body) {
  KnownCall &call = call_.emplace(region.unit.source.id());
  call.body = body;
  call.next = region.caller->next;
  call.once = region.caller->once;
  call.macro = region.caller->macro;
  call.skip = numberOf(live.skip);
  MachineState &state = live.state;
  state.cutArea.takeAdded();
  state.fedFrom.takeMoves();
  call.run.entry = state;
  origin_ = state.origin;
  rules_.dispatcher().remember(call.run.memory);
  rules_.dispatcher().startGathering();
  reports_ = rules_.collector().reports();
  startNoting(call);
}

void CallRecorder::startNoting(KnownCall &call) {
  spoilt_ = run_.opaque = false;
  complete_ = run_.complete;
  call.repeated = run_.repeated;
  call.steps = run_.steps;
  call.workBefore = workDone;
  call.stops = run_.stops;
  call.forks = run_.forks;
  UsedTargets &used = run_.used;
  for (auto *numbers : {&used.numbers, &used.programs})
    numbers->startNoting();
  for (auto *names : {&used.labels, &used.names})
    names->startNoting();
  for (auto *places : {&used.localSubprograms, &used.profiles, &used.bracketed})
    places->startNoting();
  usesNumber_ = std::exchange(used.anyNumber, false);
  run_.covered.note(&call.covered, &call.texts);
  run_.unit.index.takeLooks();
  run_.unit.index.notePlaces(&call.texts);
  useBefore_ = std::exchange(stateUse, StateUse());
}

void CallRecorder::stopNoting(KnownCall &call) {
  run_.covered.note(nullptr, nullptr);
  run_.unit.index.notePlaces(nullptr);
  spoilt_ |= run_.unit.index.takeLooks().anywhere;
  UsedTargets &used = run_.used;
  call.numbers = once(used.numbers.takeNoted());
  call.programs = once(used.programs.takeNoted());
  call.labels = once(used.labels.takeNoted());
  call.names = once(used.names.takeNoted());
  for (auto *places : {&used.localSubprograms, &used.profiles, &used.bracketed})
    spoilt_ |= !places->takeNoted().empty();
  spoilt_ |= used.anyNumber;
  used.anyNumber |= usesNumber_;
  sortPlaces(call.covered);
  sortPlaces(call.texts);
  call.repeated = run_.repeated - call.repeated;
  call.steps = run_.steps - call.steps;
  call.workAfter = workDone;
  call.stops = run_.stops - call.stops;
  call.forks = run_.forks - call.forks;
}

/// Whether the call has run to its end in one way, and nothing was to be said.
bool CallRecorder::isWhole(const Exits &exits) const {
  return !spoilt_ && !run_.opaque && !run_.stopped && !run_.abstract &&
         complete_ == run_.complete && reports_ == rules_.collector().reports() &&
         exits.size() == 1 && exits.front().target == notSet &&
         numberOf(exits.front().live.skip) == call_->skip &&
         !exits.front().live.state->modalCalls && call_->steps >= shortestRun &&
         call_->texts.size() <= mostTexts;
}

void CallRecorder::end(Exits &exits) {
  KnownCall &call = *call_;
  stopNoting(call);
  const StateUse use = stateUse;
  stateUse |= useBefore_;
  if (isWhole(exits)) {
    MachineState &state = exits.front().live.state;
    RuleMemory memory(call.run.memory.file());
    rules_.dispatcher().remember(memory);
    call.run.cut = state.cutArea.takeAdded();
    call.run.depth = state.fedFrom.takeMoves();
    if (call.run.memory.isSame(memory, use.aside)) {
      call.run.finish(use, origin_, state, PlainRun());
      call.run.gathered = rules_.dispatcher().gathered();
      runs_.calls.insert(std::move(call));
    }
  }
  call_.reset();
}

} // namespace ncvet
