// Where a cycle leaves the tool that makes passes along a turned contour.
#pragma once

#include "analyzer/flow/cycle_contour.h"
#include "analyzer/flow/flow_listener.h"
#include "interp/cycles/block_moves.h"

namespace ncvet {

/// Watches the blocks of the contour, beside whoever else does.
class PassesEnd final : public BlockWatcher {
public:
  PassesEnd(const ExecutedBlock &executed, ContourCycle cycle, BlockWatcher *beside)
      : cycle_(std::move(cycle)), contour_(executed.dialect), beside_(beside) {
    contour_.begin(executed, cycle_);
  }

  void executed(const FileUnit &unit, const Block &block, const Outcome &outcome,
                const MachineState &before, const MachineState &after) override {
    if (beside_)
      beside_->executed(unit, block, outcome, before, after);
    if (lost_ || !after.profile)
      return;
    const ExecutedBlock executed{*unit.dialect, unit.machine, block, outcome, before, after};
    moves_.clear();
    appendMoves(executed, moves_);
    contour_.take(executed, moves_);
  }
  void lost(SourceRange where, llvm::StringRef why) override {
    lost_ = true;
    if (beside_)
      beside_->lost(where, why);
  }

  /// The last motion of the passes; none where something that they need is not known.
  std::optional<Move> last() {
    std::optional<Move> move;
    if (!lost_ && cycle_.profile)
      profilePasses(*cycle_.profile, cycle_.start, cycle_.feed, contour_.end(cycle_),
                    [&](const Move &given) { move = given; });
    return move;
  }

private:
  ContourCycle cycle_;
  CycleContour contour_;
  BlockWatcher *beside_;
  llvm::SmallVector<Move, 8> moves_;
  bool lost_ = false;
};

} // namespace ncvet
