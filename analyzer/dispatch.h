// Hands the events of a block to the rules that listen for them.
#pragma once

#include "analyzer/collector.h"
#include "analyzer/project.h"

namespace ncvet {

/// The rules of one run, made and subscribed for one dialect.
class Dispatcher {
public:
  Dispatcher(const Dialect &dialect, const RuleSelection &selection, Collector &collector);

  /// Events of these kinds have listeners.
  uint32_t kinds() const { return kinds_; }
  void dispatch(FileUnit &unit, const Block &block, const Outcome &outcome,
                const MachineState &before, const MachineState &after, unsigned callDepth);
  /// A `FlowIssue` event of its own, outside of what the block itself emitted.
  void flowIssue(FlowIssue issue, FileUnit &unit, const Block &block, const Outcome &outcome,
                 const MachineState &before, const MachineState &after, unsigned callDepth,
                 SourceRange where, SourceRange related);
  /// A `CallReturned` event at the call: the state before the call and the one that came back.
  void callReturned(FileUnit &unit, const Block &block, const Outcome &outcome,
                    const MachineState &before, const MachineState &after, unsigned callDepth);
  void finish(const FileSummary &summary, FileUnit &unit);

private:
  struct Listener {
    Rule *rule;
    RuleId id;
  };
  void prepare(FileUnit &unit, const Block &block, const Outcome &outcome,
               const MachineState &before, const MachineState &after, unsigned callDepth);

  std::vector<std::unique_ptr<Rule>> rules_;
  std::vector<Listener> all_;
  std::array<std::vector<Listener>, size_t(EventKind::Count)> byKind_;
  std::vector<std::vector<Listener>> byCode_;
  uint32_t kinds_ = 0;
  RuleContext context_;
};

} // namespace ncvet
