// The rules as listeners of a run.
#pragma once

#include "analyzer/flow/flow_listener.h"
#include "analyzer/rule/dispatch.h"

namespace ncvet {

/// Tells the selected rules what happens, and collects what they find.
class RuleHost final : public FlowListener {
public:
  /// `visits` of the run that is listened to.
  RuleHost(FileUnit &unit, const RuleSelection &rules, const AnalysisLimits &limits,
           Visits &visits);

  /// Every rule is told of all that it listens for, whatever it has said of blocks like it.
  void tellInFull() { dispatcher_.tellInFull(); }
  /// Runs of blocks are recorded.
  void recordUses() { dispatcher_.recordUses(); }
  const Dispatcher &dispatcher() const { return dispatcher_; }
  const Collector &collector() const { return collector_; }
  /// All findings, sorted.
  std::vector<Finding> take(const SourceSet &sources) { return collector_.take(sources); }

  FlowInterest interest() const override;
  void executed(const Step &step, bool continues) override;
  size_t executedRow(const Step &step, const HoleRow &row, size_t most) override;
  bool sleepsThrough(uint64_t stretch) const override { return dispatcher_.sleepThrough(stretch); }
  bool wantsStill() const override { return dispatcher_.wantsStill(); }
  bool executedAgain(const Step &step) override;
  void problem(const Step &step, const FlowProblem &problem) override;
  void callReturned(const Step &step, const MachineState &after) override;
  void entered(EntryState entry) override;
  void stopEnded() override { collector_.settle(); }
  void unreached(FileUnit &unit, const Block &block, const Outcome &outcome,
                 const MachineState &before, const MachineState &after) override;
  void finished(const FileSummary &summary) override;

private:
  FileUnit &unit_;
  Collector collector_;
  Dispatcher dispatcher_;
  RuleMemory before_, after_; ///< of a block that was told again; kept for their storage
};

} // namespace ncvet
