// Cycles that work along a contour of blocks: what their own block says, and the motions that they
// make once the contour is read.
#pragma once

#include "formats/dialect/measure.h"
#include "interp/geometry/profile_passes.h"
#include "interp/state/executed_block.h"

#include <optional>

namespace ncvet {

/// Of one cycle along a contour: no program is followed without end.
constexpr size_t mostContourMoves = 200'000;

/// A cycle with its contour still to come. Pairs are of X and Z, X of a lathe as a radius.
struct ContourCycle {
  CycleKind kind = CycleKind::None;
  uint32_t traits = 0; ///< as of `CodeInfo`
  /// Where the tool is before the cycle, and comes back to.
  Move start;
  Move feed;                                 ///< a motion at the cycle's feed
  std::array<double, 2> lengths{1, 1};       ///< what a coordinate counts for a millimetre of way
  std::optional<double> depth, passes;       ///< mm; number of repeated contours
  std::array<std::optional<double>, 2> rest; ///< mm left for finishing
  std::array<std::optional<double>, 2> last; ///< mm taken by one more pass along the contour
  std::array<std::optional<double>, 2> way;  ///< mm from the first repeated contour to the last
  Interval retract;                          ///< mm
  // of milling along a contour
  Axis tool = Axis::Z;
  Interval approach, back;               ///< levels along the tool's axis
  llvm::SmallVector<Interval, 8> levels; ///< of the passes
  std::optional<Interval> feedDown;      ///< mm/min
  bool onContour = true;                 ///< false: the passes keep a distance from it
  // of turning in passes that are not stated
  bool roughs = true, finishes = false;
  Interval finishFeed;

  /// Of passes along a turned contour; none: not all that they need is known.
  std::optional<ProfilePasses> profile;

  bool bothAxes = false; ///< the first block of the contour names both axes: type 2

  bool has(CycleTrait trait) const { return traits >> unsigned(trait) & 1; }
};

/// The cycle that the block runs along a contour, when it does.
std::optional<ContourCycle> contourCycle(const ExecutedBlock &executed);

/// Moves `move` aside by what a finishing pass leaves.
void shiftByRest(const ContourCycle &cycle, Move &move);

/// Gives the motions of a cycle that roughs along `contour`, of which the first motion leads to its
/// first point. Coordinates that are not known stay so.
void roughContour(const ContourCycle &cycle, llvm::ArrayRef<Move> contour,
                  llvm::function_ref<void(const Move &)> give);

/// Gives the motions of a cycle that mills along `contour`: at each level the contour itself; how
/// the tool comes to it and leaves it the manuals do not say.
void millContour(const ContourCycle &cycle, llvm::ArrayRef<Move> contour,
                 llvm::function_ref<void(const Move &)> give);

/// Gives the motions of a cycle that turns along `contour` (CycleTrait::TurnsContour).
void turnContour(const ContourCycle &cycle, llvm::ArrayRef<Move> contour,
                 llvm::function_ref<void(const Move &)> give);

/// Gives the path back from the contour's last point to where the cycle began.
void returnToStart(const ContourCycle &cycle, const Place &from,
                   llvm::function_ref<void(const Move &)> give);

} // namespace ncvet
