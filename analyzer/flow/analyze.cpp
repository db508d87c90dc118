// The facade: checks one program with everything that it calls.
#include "analyzer/flow/analyze.h"

#include "analyzer/flow/engine.h"

namespace ncvet {

AnalysisResult analyze(Project &project, FileUnit &unit, const RuleSelection &rules,
                       const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                       StraightRuns *runs) {
  return Engine(project, unit, rules, limits, cancel, runs).run();
}

} // namespace ncvet
