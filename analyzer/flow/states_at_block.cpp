// The machine's states at one block: the analysis run again, looking at that block.
#include "analyzer/flow/states_at_block.h"

#include "analyzer/flow/engine.h"

namespace ncvet {

StatesAt statesAt(Project &project, FileUnit &entry, const FileUnit &unit, uint32_t offset,
                  const AnalysisLimits &limits, const std::atomic<bool> *cancel) {
  RuleSelection none;
  none.enabled.resize(allRules().size());
  none.asked.resize(allRules().size());
  none.severity.resize(allRules().size());
  ObservedBlock observed(unit.source.id(), offset);
  return Engine(project, entry, none, limits, cancel).observe(observed);
}

StatesAt statesAt(Project &project, FileUnit &unit, uint32_t offset, const RuleSelection &rules,
                  const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                  StraightRuns &runs) {
  ObservedBlock observed(unit.source.id(), offset);
  return Engine(project, unit, rules, limits, cancel, &runs).observe(observed);
}

} // namespace ncvet
