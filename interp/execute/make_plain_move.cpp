// Makes of a block that has been executed a plain move that may follow itself.
#include "interp/execute/make_plain_move.h"

#include "interp/execute/execution.h"

namespace ncvet {

std::optional<PlainMove> makePlainMove(const Dialect &dialect, const MachineProfile &machine,
                                       const ModeMasks &masks, FileId file, const Block &block,
                                       MachineState &after, Outcome &outcome) {
  const StateUse used = stateUse;
  auto move = Execution(dialect, machine, masks, file, block, after, after, outcome).asPlainMove();
  stateUse = used;
  return move;
}

} // namespace ncvet
