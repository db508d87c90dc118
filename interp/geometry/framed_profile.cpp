// A turned contour in the frame in which passes along it lead one way and climb.
#include "interp/geometry/framed_profile.h"

namespace ncvet {

void FramedProfile::lead() {
  const Point way = first() - pieces_.back().to;
  if (way.y() > 0) {
    map([](const Point &p) { return Point(p.x(), -p.y()); }, true);
    flippedUp_ = !flippedUp_;
  }
  if (way.x() < 0) {
    map([](const Point &p) { return Point(-p.x(), p.y()); }, true);
    flippedAlong_ = !flippedAlong_;
  }
}

Point FramedProfile::inWorkpiece(Point p) const {
  if (flippedAlong_)
    p.x() = -p.x();
  if (flippedUp_)
    p.y() = -p.y();
  return turned_ ? Point(-p.y(), p.x()) : p;
}

bool FramedProfile::keepDistance(double distance, size_t &looks) {
  lead();
  const Point toFirst = first() - start_, toLast = pieces_.back().from - start_;
  if (cross(toLast, toFirst) < 0)
    distance = -distance;
  for (double done = 0; !(std::fabs(distance - done) <= ProfileLimits::noLength);) {
    if ((looks += pieces_.size()) > ProfileLimits::mostLooks)
      return false;
    double step = std::fabs(distance - done);
    for (const ProfilePiece &piece : pieces_)
      step = std::min(step, piece.size() / 2);
    if (!move(distance < 0 ? -step : step))
      return false;
    done += distance < 0 ? -step : step;
  }
  for (size_t i = 0; i + 1 < pieces_.size(); ++i)
    pieces_[i].to = pieces_[i + 1].from = (pieces_[i].to + pieces_[i + 1].from) / 2;
  return true;
}

bool FramedProfile::move(double step) {
  ProfilePieces moved;
  for (ProfilePiece piece : pieces_) {
    piece.offset(step);
    if (piece.size() < ProfileLimits::shortest)
      continue;
    if (!moved.empty() && moved.back().to.x() - piece.from.x() > ProfileLimits::widestGap) {
      ProfilePiece before = moved.back(), after = piece;
      before.offset(-step);
      after.offset(-step);
      moved.push_back({moved.back().to, piece.from, true, step > 0, (before.to + after.from) / 2});
    }
    moved.push_back(piece);
  }
  for (size_t i = 0; i + 1 < moved.size(); ++i)
    if (!meet(moved[i], moved[i + 1]))
      return false;
  pieces_ = std::move(moved);
  return !pieces_.empty();
}

} // namespace ncvet
