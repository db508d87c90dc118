// Hands the events of a block to the rules that listen for them.
#pragma once

#include "analyzer/collector.h"
#include "analyzer/project.h"

namespace ncvet {

/// The rules of one run, made and subscribed for one dialect.
class Dispatcher {
public:
  Dispatcher(const Dialect &dialect, const MachineProfile &machine, const RuleSelection &selection,
             Collector &collector);

  /// Events of these kinds have listeners.
  uint32_t kinds() const { return kinds_; }
  void dispatch(FileUnit &unit, const Block &block, const Outcome &outcome,
                const MachineState &before, const MachineState &after, unsigned callDepth);
  /// As `dispatch`, for a plain move that only goes on as the block before: told to those who want
  /// to know of every move.
  void dispatchMove(FileUnit &unit, const Block &block, const Outcome &outcome,
                    const MachineState &before, const MachineState &after, unsigned callDepth) {
    if (!everyBlock_.empty())
      tellMove(unit, block, outcome, before, after, callDepth);
  }
  /// A `FlowIssue` event of its own, outside of what the block itself emitted.
  void flowIssue(FlowIssue issue, FileUnit &unit, const Block &block, const Outcome &outcome,
                 const MachineState &before, const MachineState &after, unsigned callDepth,
                 SourceRange where, SourceRange related);
  /// A `CallReturned` event at the call: the state before the call and the one that came back.
  void callReturned(FileUnit &unit, const Block &block, const Outcome &outcome,
                    const MachineState &before, const MachineState &after, unsigned callDepth);
  void finish(const FileSummary &summary, FileUnit &unit);
  /// What the rules remember at this moment.
  void remember(RuleMemory &memory) const {
    for (const Listener &listener : all_)
      listener.rule->remember(memory);
  }

  /// Whether no rule has to be told of plain moves at feed that go on from this state.
  bool movesSleep(const MachineState &state) const {
    return llvm::all_of(everyBlock_, [&](const auto &entry) {
      const auto &[kind, listener] = entry;
      const bool told = kind == EventKind::Block || (listener.moves & bitOf(MotionKind::Feed));
      return !told || listener.rule->sleeps(state);
    });
  }

private:
  struct Listener {
    Rule *rule;
    RuleId id;
    uint8_t moves = 0xFF; ///< bit per kind of move of which `Motion` events are wanted

    bool wants(const Event &event) const {
      return event.kind != EventKind::Motion || (moves & bitOf(event.motion));
    }
  };
  void tellMove(FileUnit &unit, const Block &block, const Outcome &outcome,
                const MachineState &before, const MachineState &after, unsigned callDepth);
  void prepare(FileUnit &unit, const Block &block, const Outcome &outcome,
               const MachineState &before, const MachineState &after, unsigned callDepth);

  std::vector<std::unique_ptr<Rule>> rules_;
  std::vector<Listener> all_;
  std::array<std::vector<Listener>, size_t(EventKind::Count)> byKind_;
  std::vector<std::vector<Listener>> byCode_;
  std::vector<std::pair<EventKind, Listener>> everyBlock_; ///< of `Block` and `Motion`
  uint32_t kinds_ = 0;
  RuleContext context_;
};

} // namespace ncvet
