// Passes along a turned contour that dive into it, cut at levels, and climb along it.
#pragma once

#include "interp/geometry/move.h"

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/STLFunctionalExtras.h"

namespace ncvet {

/// What a cycle says of such passes; lengths in the program's unit, X as a radius. After LinuxCNC
/// 2.9, `G70` to `G72.2`.
struct ProfilePasses {
  enum class Pockets : uint8_t { All, None, Only };

  bool finishing = false; ///< the contour itself, from the first distance to the last
  bool across = false;    ///< levels run along X
  Pockets pockets = Pockets::All;
  double firstDistance = 0, lastDistance = 0; ///< from the contour
  double count = 1;                           ///< passes of finishing
  double step = 1;                            ///< from one level to the next
  double retract = 0.5;                       ///< away from the work, along both axes
  double unit = 1;                            ///< mm of a length

  /// Whether a pass runs beside the contour.
  bool keepsDistance() const {
    return lastDistance != 0 || (finishing && count > 1 && firstDistance != 0);
  }
};

/// Gives the motions of the passes along `contour`, of which the first motion leads to its first
/// point. `start` is a rapid to where they begin, `feed` a motion at the feed. Gives nothing, and
/// says false, where a coordinate is not known or the interpreter would stop.
bool profilePasses(const ProfilePasses &passes, const Move &start, const Move &feed,
                   llvm::ArrayRef<Move> contour, llvm::function_ref<void(const Move &)> give);

} // namespace ncvet
