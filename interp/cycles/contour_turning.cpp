// The motions of cycles that turn along a contour in passes that nobody states: what is known is
// that finishing goes along the contour.
#include "interp/cycles/contour_cycle.h"

namespace ncvet {

void turnContour(const ContourCycle &cycle, llvm::ArrayRef<Move> contour,
                 llvm::function_ref<void(const Move &)> give) {
  Move somewhere = cycle.start;
  for (const Axis axis : {Axis::X, Axis::Z})
    somewhere.to[size_t(axis)] = Interval::unknown();
  give(somewhere);
  if (cycle.roughs) {
    Move cut = cycle.feed;
    cut.kind = MoveKind::Linear;
    cut.to = somewhere.to;
    give(cut);
  }
  if (cycle.finishes && !contour.empty()) {
    for (Move move : contour) {
      if (move.kind != MoveKind::Rapid) {
        move.feed = cycle.finishFeed;
        move.feedMode = cycle.feed.feedMode;
      }
      give(move);
    }
  }
  give(somewhere);
}

} // namespace ncvet
