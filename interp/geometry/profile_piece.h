// One line or arc of a turned contour, in the frame of the passes along it.
#pragma once

#include "interp/geometry/point.h"

#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// The interpreter's own: below them points are one, pieces are gone, a contour does not turn back.
struct ProfileLimits {
  static constexpr double samePoint = 1e-6;
  static constexpr double sameArcEnd = 1e-3;
  static constexpr double shortest = 1e-3;
  static constexpr double turnsBack = 1e-3;
  static constexpr double noLength = 1e-12;
  static constexpr double atTop = 1e-9;       ///< of an arc, or at its bottom
  static constexpr double widestGap = 1e-2;   ///< between two pieces that are led to their meeting
  static constexpr size_t mostMoves = 200000; ///< of one cycle: no program is followed without end
  /// Looks at pieces that one cycle may cost: a contour of many pieces takes as long as any other.
  static constexpr size_t mostLooks = 20000000;
};

/// A line or an arc of the contour. Its first coordinate counts along the cut and the second one
/// away from the axis.
struct ProfilePiece {
  Point from, to;
  bool arc = false;
  bool counterClockwise = false;
  Point centre{0, 0};

  double radius() const { return (from - centre).norm(); }
  /// What the piece may lose before nothing is left of it.
  double size() const {
    const double chord = (to - from).norm();
    return arc ? std::min(chord, radius()) : chord;
  }
  /// Whether all of it leads in the direction of the cut.
  bool isSteady() const;
  /// Whether the ray from an arc's centre to `point` meets the arc.
  bool spans(const Point &point) const;
  /// Where it has this height: none, one or two places along the cut.
  llvm::SmallVector<double, 2> at(double height) const;
  /// Parallel, on the left of its path for a distance above zero when it is a line.
  void offset(double distance);
};

using ProfilePieces = llvm::SmallVector<ProfilePiece, 16>;

/// Leads the end of `a` and the begin of `b` to where the two meet; false: they never do.
bool meet(ProfilePiece &a, ProfilePiece &b);

} // namespace ncvet
