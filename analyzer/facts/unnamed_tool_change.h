// Tool changes for which no T word has named a tool: what turns in the spindle then is not the
// program's.
#pragma once

#include "analyzer/rule/rule.h"

#include <set>

namespace ncvet {

/// Remembers the blocks that change the tool without a name. Which of them is the last one on the
/// way to a block, the state says.
class NamelessChanges {
public:
  void see(const Event &change, const RuleContext &ctx) {
    const MachineState &before = ctx.before();
    if (change.code == noCode || !change.word || ctx.block().has(letterAddress('T')) ||
        before.preselected != notSet || before.may(Fact::ToolCalled) ||
        before.may(Fact::UnknownCode))
      return;
    seen_.insert({ctx.source().id(), change.word->offset});
  }
  /// Whether the tool of `state` came in by such a change.
  bool inForce(const MachineState &state) const {
    return state.tool == notKnown && state.origin.of(StatePart::Tool).known() &&
           seen_.count(
               {state.origin.of(StatePart::Tool).file, state.origin.of(StatePart::Tool).begin});
  }

  const auto &remembered() const { return seen_; }

private:
  std::set<TextPlace> seen_;
};

} // namespace ncvet
