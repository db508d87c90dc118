// The contour of a turned part as pieces that rise or fall steadily, and where levels cut it.
#pragma once

#include "interp/geometry/move.h"
#include "interp/geometry/point.h"

#include "llvm/ADT/ArrayRef.h"
#include "llvm/ADT/SmallVector.h"

namespace ncvet {

/// A line, or a part of an arc within a quarter of its circle. Its points are of Z, and X as a
/// radius.
struct ContourPiece {
  Point from, to;
  bool arc = false;
  Point centre = Point::Zero();
  double radius = 0;
  std::array<double, 2> side{}; ///< of an arc: on which side of its centre it lies, by the signs
  bool clockwise = false;       ///< from +Z to +X is counter-clockwise

  /// Where the piece has `value` along `axis` (0: Z, 1: X); it does have it.
  Point at(size_t axis, double value) const;
};

/// The piece's end from `from` on, as a motion in coordinates; `lengths` as in `ContourCycle`.
class TurnedContour {
public:
  /// Of motions in X and Z, the first of which leads to the first point. `lengthsOfX`: 2 when X is
  /// a diameter.
  TurnedContour(llvm::ArrayRef<Move> moves, double lengthsOfX);

  bool known() const { return known_; } ///< all of it, and it is not empty
  llvm::ArrayRef<ContourPiece> pieces() const { return pieces_; }
  Point first() const { return pieces_.front().from; }
  Point last() const { return pieces_.back().to; }
  /// Whether it never turns back along the axis.
  bool isSteady(size_t axis) const;

  /// A part of the contour that lies at a level or beyond it.
  struct Part {
    Point from, to;
    size_t firstPiece = 0, lastPiece = 0;
    bool fromBegin = false; ///< it begins with the contour
    bool toEnd = false;     ///< it ends with the contour
  };
  /// The parts that lie beyond `level` along `axis` in the direction of `sign` (or on it), within
  /// `within` when it is given.
  llvm::SmallVector<Part, 4> beyond(size_t axis, double level, double sign,
                                    const Part *within = nullptr) const;
  /// The value of the part along `axis` that is farthest in the direction of `sign`.
  double farthest(size_t axis, double sign, const Part &part) const;
  Part whole() const;

  /// The same contour elsewhere.
  void shift(const Point &by);

private:
  void add(const Point &from, const Move &move, double lengthsOfX);
  void addArc(const Point &from, const Point &to, const Move &move, double lengthsOfX);

  bool known_ = false;
  llvm::SmallVector<ContourPiece, 16> pieces_;
};

} // namespace ncvet
