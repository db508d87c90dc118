// A turned contour in the frame in which passes along it lead one way and climb.
#pragma once

#include "interp/geometry/profile_piece.h"

#include "llvm/ADT/STLExtras.h"

namespace ncvet {

/// A contour after the path to it, in the frame in which it leads in the direction of -1, up.
class FramedProfile {
public:
  FramedProfile(const Point &start, ProfilePieces pieces)
      : start_(start), pieces_(std::move(pieces)) {}

  const Point &start() const { return start_; }
  void setStart(const Point &start) { start_ = start; }
  const Point &first() const { return pieces_.front().from; }
  const ProfilePieces &pieces() const { return pieces_; }
  bool isSteady() const {
    return llvm::all_of(pieces_, [](const ProfilePiece &piece) { return piece.isSteady(); });
  }
  /// By a quarter turn: levels across are levels along.
  void turn() {
    map([](const Point &p) { return Point(p.y(), -p.x()); }, /*mirrors=*/false);
    turned_ = !turned_;
  }
  /// Mirrored so that it climbs in the direction of the cut.
  void lead();
  /// Z and X of a point of this frame.
  Point inWorkpiece(Point p) const;
  bool isMirrored() const { return flippedAlong_ != flippedUp_; }

  /// The contour that runs at this distance, on the side of the start; false: none can be made.
  /// `looks` counts those at pieces.
  bool keepDistance(double distance, size_t &looks);
  void closeAt(double height) {
    const Point end = pieces_.back().to;
    if (end.y() < height)
      pieces_.push_back({end, {end.x(), height}});
  }

private:
  template <typename Map>
  void map(const Map &map, bool mirrors) {
    start_ = map(start_);
    for (ProfilePiece &piece : pieces_) {
      piece.from = map(piece.from);
      piece.to = map(piece.to);
      piece.centre = map(piece.centre);
      piece.counterClockwise ^= mirrors;
    }
  }
  /// By so little that no piece vanishes.
  bool move(double step);

  Point start_;
  ProfilePieces pieces_;
  bool turned_ = false, flippedAlong_ = false, flippedUp_ = false;
};

} // namespace ncvet
