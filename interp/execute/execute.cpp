// The transfer function: what one block does to the machine's state.
#include "interp/execute/execute.h"

#include "interp/execute/execution.h"

namespace ncvet {

Executor::Executor(const Dialect &dialect, const MachineProfile &machine, FileId file)
    : dialect_(dialect), machine_(machine), file_(file), masks_(dialect, machine) {}

const Item *Executor::guardOf(const Block &block) {
  const auto item =
      llvm::find_if(block.items, [](const Item &i) { return i.kind == ItemKind::If; });
  if (item == block.items.end() ||
      (item + 1 != block.items.end() && item[1].kind == ItemKind::Jump))
    return nullptr;
  return item;
}

Truth Executor::guard(const Block &block, const MachineState &state) const {
  const Item *const item = guardOf(block);
  return item ? truthOf(evaluate(block, item->condition, state, nullptr)) : Truth::Yes;
}

void Executor::execute(const Block &block, const MachineState &before, MachineState &state,
                       Outcome &outcome, bool guardHolds) const {
  outcome.clear();
  Execution(dialect_, machine_, masks_, file_, block, before, state, outcome).run(guardHolds);
}

} // namespace ncvet
