// Where a cycle leaves the tool that makes passes along a turned contour.
#pragma once

#include "analyzer/flow/activation.h"
#include "analyzer/flow/cycle_contour.h"
#include "analyzer/flow/flow_listener.h"
#include "interp/cycles/block_moves.h"

namespace ncvet {

/// Listens to the blocks of the contour.
class PassesEnd final : public FlowListener {
public:
  PassesEnd(const ExecutedBlock &executed, ContourCycle cycle)
      : cycle_(std::move(cycle)), contour_(executed.dialect) {
    contour_.begin(executed, cycle_);
  }

  FlowInterest interest() const override { return {0, false, true, true}; }
  void executed(const Step &step, bool /*continues*/) override {
    if (lost_ || step.live.state->profile == ProfileMode::Off)
      return;
    const ExecutedBlock executed = step.executed();
    moves_.clear();
    appendMoves(executed, moves_);
    contour_.take(executed, moves_);
  }
  void pathLost(SourceRange, llvm::StringRef) override { lost_ = true; }

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
  llvm::SmallVector<Move, 8> moves_;
  bool lost_ = false;
};

} // namespace ncvet
