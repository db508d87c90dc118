// The contour that a cycle reads, as motions.
#pragma once

#include "interp/cycles/contour_cycle.h"
#include "interp/path/corner_path.h"

namespace ncvet {

/// Gathers the contour block by block, with its corners put in.
class CycleContour {
public:
  explicit CycleContour(const Dialect &dialect) : corners_(dialect) {}

  /// The block that runs the cycle.
  void begin(const ExecutedBlock &executed, const ContourCycle &cycle);
  /// A block of the contour, and its motions.
  void take(const ExecutedBlock &executed, llvm::ArrayRef<Move> moves);
  /// All of it, without the cycle's own start; nothing when there is too much. `cycle` learns which
  /// axes its first block names.
  llvm::ArrayRef<Move> end(ContourCycle &cycle);

private:
  void add(const Move &move, const CornerRequest &corner, const std::array<Axis, 2> &plane);

  const CornerWords corners_;
  std::optional<CornerPath> path_;
  llvm::SmallVector<Move, 0> moves_;
  bool readsCorners_ = true, first_ = true;
  uint16_t axes_ = 0; ///< that the first block names
};

} // namespace ncvet
