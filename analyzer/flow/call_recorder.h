// Takes over what called programs did in an earlier analysis, and records what they do.
#pragma once

#include "analyzer/flow/flow_run.h"
#include "analyzer/flow/rule_host.h"
#include "analyzer/reuse/run_cache.h"

namespace ncvet {

/// The body of a region, run for a state.
BodyRun bodyRunOf(const Region &region, uint64_t state);

/// At work while the main program of a file is followed: for the calls that it makes itself, with
/// all that their programs call in turn.
class CallRecorder {
public:
  CallRecorder(FlowRun &run, StraightRuns &runs, const RuleHost &rules)
      : run_(run), runs_(runs), rules_(rules) {}

  /// Whether the call is one that can be recorded or taken over.
  bool mayReuse(const Region &region, const Live &live) const;
  /// What the call did for the same state, if `may` allows to take it over; the state becomes what
  /// it became then. Null: the program is to be run.
  const KnownCall *takeOver(const Region &region, Live &live,
                            llvm::function_ref<bool(const KnownCall &)> may);
  /// The program runs now, up to `end`.
  void begin(const Region &region, Live &live, const BodyRun &body);
  void end(Exits &exits);
  /// In it another body runs, for a state for which it has not run before.
  void noteInner(const BodyRun &body) {
    if (call_)
      call_->inner.push_back(body);
  }
  bool isRecording() const { return call_.has_value(); }
  /// What it does there is known from before; `texts`: what was looked at for that.
  void noteRecalled(const BodyRun &body, llvm::ArrayRef<KnownCall::Text> texts);
  /// What is looked at from now on, up to `textsSince`.
  size_t startTexts();
  std::vector<KnownCall::Text> textsSince(size_t start) const;
  /// What is being recorded depends on what was done elsewhere.
  void spoil() { spoilt_ = true; }

private:
  bool fits(const KnownCall &call, const Region &region, const Live &live,
            const RuleMemory &memory) const;
  void apply(const KnownCall &call, Live &live);
  void startNoting(KnownCall &call);
  void stopNoting(KnownCall &call);
  bool isWhole(const Exits &exits) const;

  FlowRun &run_;
  StraightRuns &runs_;
  const RuleHost &rules_;
  std::optional<KnownCall> call_; ///< that is being recorded
  OriginState origin_;            ///< when it began
  StateUse useBefore_;
  uint64_t reports_ = 0;
  bool complete_ = true;
  bool spoilt_ = false;
  bool usesNumber_ = false; ///< see `UsedTargets::anyNumber`, before it
};

} // namespace ncvet
