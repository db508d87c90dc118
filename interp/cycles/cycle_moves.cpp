// The motions of canned cycles: which file takes a cycle apart.
#include "interp/cycles/cycle_moves.h"

#include "interp/cycles/contour_cycle.h"

namespace ncvet {

namespace {

/// The cycle that runs: at the places of a pattern it is the active one.
const CodeInfo *cycleOf(const ExecutedBlock &executed, const Event &event) {
  if (event.code == noCode)
    return nullptr;
  const CodeInfo *code = &executed.dialect.codes[event.code];
  if (code->cycle != CycleKind::Pattern)
    return code;
  const CodeInfo *active = executed.after.activeCode(executed.dialect, StandardGroup::Cycle);
  return active && active->action == Action::Cycle ? active : nullptr;
}

} // namespace

void appendCycleMoves(const ExecutedBlock &executed, const Event &event,
                      llvm::SmallVectorImpl<Move> &moves) {
  if (const CodeInfo *cycle = cycleOf(executed, event)) {
    if (cycle->cycle >= CycleKind::Drill && cycle->cycle < CycleKind::TurnPass) {
      // The words of a pattern are not those of the cycle that runs at its places.
      static const Block none;
      const bool own = cycle == &executed.dialect.codes[event.code];
      return appendDrillingMoves({executed.dialect, executed.machine, own ? executed.block : none,
                                  executed.outcome, executed.before, executed.after},
                                 *cycle, moves);
    }
    if (cycle->cycle == CycleKind::ThreadInfeed)
      return appendInfeedThreadMoves(executed, *cycle, moves);
    if (cycle->cycle == CycleKind::ThreadChain)
      return appendThreadChainMoves(executed, *cycle, moves);
    if (cycle->cycle == CycleKind::ThreadMill)
      return appendThreadMillingMoves(executed, *cycle, moves);
    if (contourCycle(executed) || appendTurningMoves(executed, *cycle, moves) ||
        appendThreadMoves(executed, *cycle, moves) || appendAreaMoves(executed, *cycle, moves))
      return;
  }
  Move &move = moves.emplace_back();
  move.to = executed.after.position;
  move.machineAxes = executed.after.machineAxes;
}

} // namespace ncvet
