// The facade: checks one program with everything that it calls.
#include "analyzer/flow/analyze.h"

#include "analyzer/flow/engine.h"

namespace ncvet {

AnalysisResult analyze(Project &project, FileUnit &unit, const RuleSelection &rules,
                       const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                       StraightRuns *runs, const OuterCalls *outer) {
  Engine engine(project, unit, limits, cancel);
  RuleHost host(unit, rules, limits, engine.visits);
  engine.listen(host);
  if (runs)
    engine.reuse(*runs, host);
  if (outer)
    engine.leaveToCallers(*outer);
  engine.run();
  AnalysisResult result;
  result.blocks = engine.blockCount();
  result.complete = engine.isComplete();
  result.cuts = engine.cutsMade();
  result.postponed = engine.postponed;
  result.asksOuter = engine.hasAskedOuter();
  result.followed = engine.followedCalls();
  if (!result.postponed)
    result.findings = host.take(project.sources());
  return result;
}

} // namespace ncvet
