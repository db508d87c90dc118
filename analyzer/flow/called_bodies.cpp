// Runs called bodies, and remembers what each did for which state.
#include "analyzer/flow/called_bodies.h"

namespace ncvet {

namespace {

/// Results of one called program that are remembered.
constexpr size_t memosPerProgram = 64;
/// What a called body costs besides its blocks, in plain moves: states are copied and compared.
constexpr uint64_t workOfCall = 16;
/// What it costs to find and to copy what a body did before.
constexpr uint64_t workOfRecall = 4;

} // namespace

/// What the body did for the same state before.
std::optional<Exits> CalledBodies::recall(const std::vector<Memo> &memos, uint64_t print,
                                          unsigned sections, const Live &live) {
  if (run_.listeners.followOnePath())
    return std::nullopt;
  run_.repeated += workOfRecall;
  for (const Memo &memo : memos)
    if (memo.hash == print && sections <= memo.sections && equal(memo.entry, live.state)) {
      Exits exits = memo.exits;
      run_.stops += memo.stops;
      run_.forks += memo.forks;
      for (Returned &exit : exits)
        exit.live.path = live.path;
      return exits;
    }
  return std::nullopt;
}

Exits CalledBodies::run(const Region &region, Live live) {
  auto &memos = memos_[keyOf(region)];
  const uint64_t print = hash(live.state);
  // Deeper inside repeated sections than before, one more level may be one too many.
  const unsigned sections = region.kind == RegionKind::Section ? runningSections() : 0;
  if (auto known = recall(memos, print, sections, live))
    return std::move(*known);
  run_.repeated += workOfCall;
  run_.callStack.push_back(keyOf(region));
  MachineState entry = live.state;
  const PathNode *path = live.path;
  const unsigned stops = run_.stops, forks = run_.forks;
  Lives lives;
  lives.push_back(std::move(live));
  Exits raw = run_.execute(region, std::move(lives));
  run_.callStack.pop_back();
  Exits exits;
  std::map<int64_t, Lives> byTarget;
  for (Returned &exit : raw) {
    exit.live.path = path;
    mergeInto(byTarget[exit.target], std::move(exit.live));
  }
  for (auto &[target, group] : byTarget)
    for (Live &exit : group)
      exits.push_back({std::move(exit), target});
  if (!run_.stopped && !run_.listeners.followOnePath() && memos.size() < memosPerProgram)
    memos.push_back(
        {print, std::move(entry), exits, sections, run_.stops != stops, run_.forks != forks});
  return exits;
}

unsigned CalledBodies::runningSections() const {
  return unsigned(llvm::count_if(run_.callStack, [](const RunningRegion &running) {
    return std::get<RegionKind>(running) == RegionKind::Section;
  }));
}

} // namespace ncvet
