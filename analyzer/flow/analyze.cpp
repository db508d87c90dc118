// The facade: checks one program with everything that it calls.
#include "analyzer/flow/analyze.h"

#include "analyzer/flow/engine.h"
#include "analyzer/flow/fixes_at_targets.h"

namespace ncvet {

namespace {

/// None: what was taken over of an earlier analysis must not be.
std::optional<AnalysisResult> analyzeOnce(Project &project, FileUnit &unit,
                                          const RuleSelection &rules, const AnalysisLimits &limits,
                                          const std::atomic<bool> *cancel, StraightRuns *runs,
                                          const OuterCalls *outer) {
  AnalysisLimits own = limits;
  if (outer && outer->work)
    own.repeatedBlocks = std::min(own.repeatedBlocks, *outer->work);
  Engine engine(project, unit, own, cancel);
  RuleHost host(unit, rules, own, engine.visits);
  engine.listen(host);
  if (runs) {
    engine.reuse(*runs, host);
    engine.reuseCalls();
  }
  if (outer)
    engine.leaveToCallers(*outer);
  engine.run();
  if (engine.stale)
    return std::nullopt;
  AnalysisResult result;
  result.blocks = engine.blockCount();
  result.complete = engine.isComplete();
  result.cuts = engine.cutsMade();
  result.postponed = engine.postponed;
  result.asksOuter = engine.hasAskedOuter();
  result.restsOnOthers = engine.hasRestedOnOthers();
  result.work = engine.workSpent();
  result.followed = engine.followedCalls();
  if (!result.postponed) {
    result.findings = host.take(project.sources());
    keepTargetsFirst({project, unit, engine.used}, result.findings);
  }
  return result;
}

} // namespace

AnalysisResult analyze(Project &project, FileUnit &unit, const RuleSelection &rules,
                       const AnalysisLimits &limits, const std::atomic<bool> *cancel,
                       StraightRuns *runs, const OuterCalls *outer) {
  auto result = analyzeOnce(project, unit, rules, limits, cancel, runs, outer);
  if (!result) {
    runs->calls.keepPlain();
    result = analyzeOnce(project, unit, rules, limits, cancel, runs, outer);
  }
  return std::move(*result);
}

} // namespace ncvet
