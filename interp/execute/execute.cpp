// The transfer function: what one block does to the machine's state.
#include "interp/execute/execute.h"

#include "interp/execute/execution.h"

namespace ncvet {

Executor::Executor(const Dialect &dialect, const MachineProfile &machine, FileId file)
    : dialect_(dialect), machine_(machine), file_(file), masks_(dialect, machine) {}

Truth Executor::guard(const Block &block, const MachineState &state) const {
  for (size_t i = 0; i < block.items.size(); ++i) {
    const Item &item = block.items[i];
    if (item.kind != ItemKind::If)
      continue;
    const bool jumps = i + 1 < block.items.size() && block.items[i + 1].kind == ItemKind::Jump;
    if (jumps)
      return Truth::Yes;
    return truthOf(evaluate(block, item.condition, state, nullptr));
  }
  return Truth::Yes;
}

void Executor::execute(const Block &block, const MachineState &before, MachineState &state,
                       Outcome &outcome, bool guardHolds) const {
  outcome.clear();
  Execution(dialect_, machine_, masks_, file_, block, before, state, outcome).run(guardHolds);
}

} // namespace ncvet
