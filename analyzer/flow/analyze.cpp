// The facade: checks one program with everything that it calls.
#include "analyzer/flow/analyze.h"

#include "analyzer/flow/engine.h"

namespace ncvet {

AnalysisResult analyze(Project &project, FileUnit &unit, const RuleSelection &rules,
                       const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                       StraightRuns *runs) {
  Engine engine(project, unit, limits, cancel);
  RuleHost host(unit, rules, limits, engine.visits);
  engine.listen(host);
  if (runs)
    engine.reuse(*runs, host);
  engine.run();
  return {host.take(project.sources()), engine.blockCount(), engine.isComplete(),
          engine.cutsMade()};
}

} // namespace ncvet
