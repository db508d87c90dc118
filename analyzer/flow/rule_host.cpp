// The rules as listeners of a run.
#include "analyzer/flow/rule_host.h"

#include "analyzer/flow/activation.h"

namespace ncvet {

RuleHost::RuleHost(FileUnit &unit, const RuleSelection &rules, const AnalysisLimits &limits,
                   Visits &visits)
    : unit_(unit), collector_(rules, *unit.dialect, limits, visits),
      dispatcher_(*unit.dialect, unit.machine, rules, collector_), before_(unit.source.id()),
      after_(unit.source.id()) {}

FlowInterest RuleHost::interest() const {
  return {dispatcher_.kinds(), dispatcher_.wantsEveryMove()};
}

static ToldBlock told(const Step &step, const MachineState &before, const MachineState &after) {
  return {step.unit(), step.block, step.outcome, before, after, step.region().caller};
}

void RuleHost::executed(const Step &step, bool continues) {
  const ToldBlock block = told(step, step.before, step.live.state);
  if (continues)
    dispatcher_.dispatchMove(block, step.stretch);
  else
    dispatcher_.dispatch(block, step.ahead, step.place);
}

size_t RuleHost::executedRow(const Step &step, const HoleRow &row, size_t most) {
  return dispatcher_.dispatchRow(told(step, step.before, step.live.state), row, most);
}

/// A rule says of a block what it said of one that differs in numbers only, unless it is told of
/// every move: when it has said nothing, and remembers what it did, it will say nothing again.
bool RuleHost::executedAgain(const Step &step) {
  before_.clear();
  dispatcher_.rememberChanges(before_);
  const uint64_t reports = collector_.reports();
  executed(step, false);
  after_.clear();
  dispatcher_.rememberChanges(after_);
  return reports == collector_.reports() && before_.isSame(after_, true);
}

void RuleHost::problem(const Step &step, const FlowProblem &problem) {
  dispatcher_.flowIssue(problem.kind, told(step, problem.before, problem.after), problem.where,
                        problem.related);
}

void RuleHost::callReturned(const Step &step, const MachineState &after) {
  dispatcher_.callReturned(told(step, step.before, after));
}

void RuleHost::entered(EntryState entry) {
  collector_.setDefiniteOnly(entry != EntryState::Known);
  collector_.setUncalled(entry == EntryState::Uncalled);
}

void RuleHost::unreached(FileUnit &unit, const Block &block, const Outcome &outcome,
                         const MachineState &before, const MachineState &after) {
  dispatcher_.dispatch({unit, block, outcome, before, after, nullptr});
}

void RuleHost::finished(const FileSummary &summary) { dispatcher_.finish(summary, unit_); }

} // namespace ncvet
