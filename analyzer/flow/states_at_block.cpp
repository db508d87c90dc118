// The machine's states at one block: the analysis run again, looking at that block.
#include "analyzer/flow/states_at_block.h"

#include "analyzer/flow/engine.h"

namespace ncvet {

namespace {

/// What the observed block has seen when all has run.
StatesAt observe(Engine &engine, ObservedBlock &observed) {
  engine.listen(observed);
  engine.run();
  observed.states.complete = engine.isComplete();
  return std::move(observed.states);
}

} // namespace

StatesAt statesAt(Project &project, FileUnit &entry, const FileUnit &unit, uint32_t offset,
                  const AnalysisLimits &limits, const std::atomic<bool> *cancel) {
  Engine engine(project, entry, limits, cancel);
  ObservedBlock observed(unit.source.id(), offset);
  return observe(engine, observed);
}

StatesAt statesAt(Project &project, FileUnit &unit, uint32_t offset, const RuleSelection &rules,
                  const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                  StraightRuns &runs) {
  Engine engine(project, unit, limits, cancel);
  RuleHost host(unit, rules, limits, engine.visits);
  engine.listen(host);
  engine.reuse(runs, host);
  ObservedBlock observed(unit.source.id(), offset);
  return observe(engine, observed);
}

StatesAt statesAfterCheck(Project &project, FileUnit &unit, uint32_t offset,
                          const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                          StraightRuns &runs) {
  Engine engine(project, unit, limits, cancel);
  engine.replay(runs);
  ObservedBlock observed(unit.source.id(), offset);
  return observe(engine, observed);
}

} // namespace ncvet
