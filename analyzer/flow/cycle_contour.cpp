// The contour that a cycle reads, as motions.
#include "analyzer/flow/cycle_contour.h"

#include "interp/path/arc_block.h"

#include <utility>

namespace ncvet {

namespace {
/// Contours with more motions are not worked along: the memory that they take is bounded.
constexpr size_t mostMoves = 100000;
} // namespace

void CycleContour::begin(const ExecutedBlock &executed, const ContourCycle &cycle) {
  moves_.clear();
  readsCorners_ = !cycle.has(CycleTrait::IgnoresCorners);
  path_.emplace(executed.dialect);
  axes_ = 0;
  first_ = true;
  add(cycle.start, {}, {Axis::Z, Axis::X});
}

void CycleContour::take(const ExecutedBlock &executed, llvm::ArrayRef<Move> moves) {
  const CornerRequest corner = readsCorners_ ? corners_.read(executed) : CornerRequest();
  const std::array<Axis, 2> plane = arcWords(executed.dialect, executed.after, executed.block).axes;
  for (const Move &move : moves)
    if (move.kind <= MoveKind::Thread && moves_.size() < mostMoves)
      add(move, corner, plane);
  if (std::exchange(first_, false))
    for (const Event &event : executed.outcome.events)
      axes_ |= event.kind == EventKind::Motion ? event.axes : 0;
}

llvm::ArrayRef<Move> CycleContour::end(ContourCycle &cycle) {
  path_->finish([&](uint64_t, const Move &move) { moves_.push_back(move); });
  constexpr uint16_t both = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
  cycle.bothAxes = (axes_ & both) == both;
  return moves_.empty() || moves_.size() >= mostMoves ? llvm::ArrayRef<Move>()
                                                      : llvm::ArrayRef<Move>(moves_).drop_front();
}

void CycleContour::add(const Move &move, const CornerRequest &corner,
                       const std::array<Axis, 2> &plane) {
  path_->add(0, move, corner, plane, [&](uint64_t, const Move &given) { moves_.push_back(given); });
}

} // namespace ncvet
