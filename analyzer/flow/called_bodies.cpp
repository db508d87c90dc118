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

/// What the body did for the same state before.
std::optional<Exits> CalledBodies::recall(Remembered &body, uint64_t print, unsigned sections,
                                          const Live &live) {
  run_.repeated += workOfRecall;
  for (const Memo &memo : body.memos)
    if (memo.hash == print && sections <= memo.sections && equal(memo.entry, live.state)) {
      body.inVain = 0;
      Exits exits = memo.exits;
      run_.stops += memo.stops;
      run_.forks += memo.forks;
      for (Returned &exit : exits)
        exit.live.path = live.path;
      return exits;
    }
  return std::nullopt;
}

bool CalledBodies::isWorthLooking(Remembered &body) {
  const bool room = body.memos.size() < memosPerProgram;
  return room || ++body.inVain <= mostInVain || body.inVain % lookedAtThen == 0;
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

Exits CalledBodies::run(const Region &region, Live live) {
  Remembered &body = remembered_[keyOf(region)];
  const bool looks = !run_.listeners.followOnePath() && isWorthLooking(body);
  const uint64_t print = looks ? hash(live.state) : 0;
  // Deeper inside repeated sections than before, one more level may be one too many.
  const unsigned sections = region.kind == RegionKind::Section ? runningSections() : 0;
  if (looks)
    if (auto known = recall(body, print, sections, live))
      return std::move(*known);
  run_.repeated += workOfCall;
  run_.callStack.push_back(keyOf(region));
  std::optional<MachineState> entry;
  if (looks && body.memos.size() < memosPerProgram)
    entry = live.state;
  const PathNode *path = live.path;
  const unsigned stops = run_.stops, forks = run_.forks;
  Lives lives;
  lives.push_back(std::move(live));
  Exits raw = run_.execute(region, std::move(lives));
  run_.callStack.pop_back();
  Exits exits = merge(std::move(raw), path);
  if (entry && !run_.stopped && body.memos.size() < memosPerProgram)
    body.memos.push_back(
        {print, std::move(*entry), exits, sections, run_.stops != stops, run_.forks != forks});
  return exits;
}

unsigned CalledBodies::runningSections() const {
  return unsigned(llvm::count_if(run_.callStack, [](const RunningRegion &running) {
    return std::get<RegionKind>(running) == RegionKind::Section;
  }));
}

} // namespace ncvet
