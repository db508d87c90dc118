// Passes along a turned contour: the finishing ones, and the levels of roughing.
#include "interp/geometry/profile_passes.h"

#include "interp/geometry/direction.h"
#include "interp/geometry/framed_profile.h"

#include <optional>

namespace ncvet {

namespace {

using Motions = llvm::SmallVector<Move, 0>;

/// Writes motions of a profile's frame.
class Pen {
public:
  Pen(const FramedProfile &profile, const Move &start, const Move &feed, double unit,
      Motions &motions)
      : profile_(profile), start_(start), feed_(feed), unit_(unit), motions_(motions) {}

  void rapid(const Point &to) { add(start_, to).kind = MoveKind::Rapid; }
  void line(const Point &to) { add(feed_, to).kind = MoveKind::Linear; }
  void arc(const ProfilePiece &piece, const Point &to) {
    const Point begin = at_ - piece.centre, end = to - piece.centre;
    Move &move = add(feed_, to);
    move.kind = MoveKind::Arc;
    move.plane = {Axis::Z, Axis::X};
    const Point centre = unit_ * profile_.inWorkpiece(piece.centre);
    move.centre = {Interval::exactly(centre.x()), Interval::exactly(centre.y())};
    move.clockwise = piece.counterClockwise == profile_.isMirrored();
    double turn = angleBetween(begin, end) / fullTurn;
    if (!piece.counterClockwise)
      turn = -turn;
    move.turns = Interval::exactly(turn > 0 ? turn : turn + 1);
  }
  void along(const ProfilePiece &piece) { piece.arc ? arc(piece, piece.to) : line(piece.to); }
  bool isFull() const { return motions_.size() >= ProfileLimits::mostMoves; }

private:
  Move &add(const Move &like, const Point &to) {
    at_ = to;
    Move &move = motions_.emplace_back(like);
    const Point place = unit_ * profile_.inWorkpiece(to);
    move.to = start_.to;
    move.machineAxes = 0;
    move.to[size_t(Axis::Z)] = Interval::exactly(place.x());
    move.to[size_t(Axis::X)] = Interval::exactly(place.y());
    return move;
  }

  const FramedProfile &profile_;
  const Move &start_, &feed_;
  const double unit_;
  Motions &motions_;
  Point at_{0, 0};
};

/// Removes what lies between the start and the contour, level by level.
class Roughing {
public:
  Roughing(const ProfilePasses &passes, const FramedProfile &profile, Pen &pen)
      : passes_(passes), pen_(pen), top_(profile.start().y()), at_(profile.start()) {
    pieces_.push_back({profile.start(), profile.first()});
    llvm::append_range(pieces_, profile.pieces());
  }

  bool run() {
    size_t piece = 0;
    if (passes_.pockets == ProfilePasses::Pockets::Only) {
      constexpr double deepest = -1e9;
      while (piece < pieces_.size() && dives(piece, deepest))
        ++piece;
    }
    const bool around = passes_.pockets == ProfilePasses::Pockets::None;
    while (piece < pieces_.size() && fits_)
      piece = pocket(piece, around);
    return fits_ && !pen_.isFull();
  }

private:
  /// Goes down along a piece to the level, or to its end; false where it climbs.
  bool dives(size_t index, double level) {
    const ProfilePiece &piece = pieces_[index];
    if (piece.arc)
      return divesAlongArc(piece, level);
    if (piece.from.y() <= piece.to.y())
      return false;
    Point to = piece.to;
    if (level >= to.y()) {
      const auto places = piece.at(level);
      if (places.empty())
        return fits_ = false;
      to = {places.front(), level};
    }
    index == 0 ? pen_.rapid(to) : pen_.line(to);
    at_ = to;
    return true;
  }
  bool divesAlongArc(const ProfilePiece &piece, double level) {
    if ((at_ - piece.to).norm() < ProfileLimits::sameArcEnd)
      return true;
    const double side = at_.x() - piece.centre.x();
    if (piece.counterClockwise ? side > ProfileLimits::atTop : side <= ProfileLimits::atTop)
      return false;
    const auto places = piece.at(level);
    const bool reaches =
        !places.empty() && (piece.counterClockwise ? places.back() <= piece.centre.x()
                                                   : places.front() >= piece.centre.x());
    const Point to =
        reaches ? Point(places[piece.counterClockwise ? places.size() - 1 : 0], level) : piece.to;
    if (!reaches || (at_ - to).norm() > ProfileLimits::sameArcEnd)
      pen_.arc(piece, to);
    at_ = to;
    return true;
  }
  /// Where the arc is at its top, or its end when that comes first.
  static Point topOf(const ProfilePiece &piece) {
    if (!piece.counterClockwise || piece.to.x() >= piece.centre.x())
      return piece.to;
    return {piece.centre.x(), piece.centre.y() + piece.radius()};
  }
  /// Goes up along a piece; false where it goes down, at once or after its top.
  bool climbs(const ProfilePiece &piece) {
    if (!piece.arc) {
      if (piece.to.y() < piece.from.y())
        return false;
      fits_ &= (at_ - piece.from).norm() <= ProfileLimits::samePoint;
      pen_.line(piece.to);
      at_ = piece.to;
      return fits_;
    }
    const double side = at_.x() - piece.centre.x();
    if (piece.counterClockwise ? side < -ProfileLimits::atTop : side > ProfileLimits::atTop)
      return false;
    const Point to = topOf(piece);
    if ((at_ - to).norm() > ProfileLimits::sameArcEnd)
      pen_.arc(piece, to);
    at_ = to;
    return !piece.counterClockwise;
  }
  /// Goes straight on to the piece and up along it, where it climbs at all.
  void climbsAfterPockets(const ProfilePiece &piece) {
    if (!piece.arc && piece.to.y() < piece.from.y())
      return;
    const auto places = piece.at(at_.y());
    if (places.empty())
      return;
    const double place = piece.arc && !piece.counterClockwise ? places.back() : places.front();
    const double side = piece.arc ? place - piece.centre.x() : 0;
    if (piece.arc &&
        (piece.counterClockwise ? side < -ProfileLimits::atTop : side > ProfileLimits::atTop))
      return;
    at_.x() = place;
    pen_.line(at_);
    const Point to = piece.arc ? topOf(piece) : piece.to;
    if (!piece.arc)
      pen_.line(to);
    else if ((at_ - to).norm() > ProfileLimits::sameArcEnd)
      pen_.arc(piece, to);
    at_ = to;
  }

  /// Cuts what lies before `piece` and after it down to where the contour climbs again, and
  /// follows it up to the next pocket, whose first piece is the answer.
  size_t pocket(size_t piece, bool around) {
    double level = top_;
    while (piece < pieces_.size() && fits_ && ++looks_ < ProfileLimits::mostLooks &&
           !pen_.isFull()) {
      while (level > at_.y() && ++looks_ < ProfileLimits::mostLooks)
        level -= passes_.step;
      if (!dives(piece, level)) {
        for (; fits_ && piece < pieces_.size(); ++piece)
          if (around)
            climbsAfterPockets(pieces_[piece]);
          else if (!climbs(pieces_[piece]))
            return piece;
        return piece;
      }
      if (at_.y() > level || std::fabs(at_.y() - level) > ProfileLimits::samePoint)
        ++piece;
      else
        piece = cut(piece, level);
    }
    fits_ &= piece >= pieces_.size();
    return piece;
  }

  /// One level from where the tool is to the next piece, and back; the piece to go on with.
  size_t cut(size_t piece, double &level) {
    for (size_t next = piece; next < pieces_.size(); ++next) {
      const auto places = pieces_[next].at(at_.y());
      if (++looks_ > ProfileLimits::mostLooks)
        break;
      if (places.empty())
        continue;
      const double place = next == piece ? places.back() : places.front();
      const double way = std::fabs(place - at_.x());
      if (way < ProfileLimits::samePoint) {
        if (next == piece)
          continue;
        // There is nothing to cut here.
        if ((at_ - pieces_[piece].to).norm() < ProfileLimits::samePoint)
          return piece + 1;
        level -= passes_.step;
        return piece;
      }
      const double away = std::min(passes_.retract, way / 2);
      pen_.line({place, at_.y()});
      pen_.rapid({place + away, at_.y() + away});
      pen_.rapid({at_.x() - away, at_.y() + away});
      piece == 0 ? pen_.rapid(at_) : pen_.line(at_);
      level -= passes_.step;
      return piece;
    }
    fits_ = false; // nothing stops the cut
    return piece;
  }

  const ProfilePasses &passes_;
  Pen &pen_;
  const double top_;
  Point at_;
  ProfilePieces pieces_; ///< the path from the start to the contour first
  bool fits_ = true;
  size_t looks_ = 0;
};

bool finish(const ProfilePasses &passes, FramedProfile profile, const Move &start, const Move &feed,
            Motions &motions) {
  constexpr double mostPasses = 10000;
  if (!(passes.count >= 0 && passes.count <= mostPasses))
    return false;
  size_t looks = 0;
  if (!profile.isSteady())
    profile.turn();
  profile.lead();
  if (profile.first().x() > profile.start().x())
    profile.setStart({profile.first().x(), profile.start().y()});
  for (auto pass = int(passes.count); pass > 0; --pass) {
    FramedProfile path = profile;
    if (!path.keepDistance((pass - 1) * (passes.firstDistance - passes.lastDistance) /
                                   passes.count +
                               passes.lastDistance,
                           looks))
      return false;
    Pen pen(path, start, feed, passes.unit, motions);
    pen.rapid(path.start());
    pen.rapid(path.first());
    for (const ProfilePiece &piece : path.pieces())
      pen.along(piece);
    if (pen.isFull())
      return false;
  }
  return true;
}

bool rough(const ProfilePasses &passes, FramedProfile profile, const Move &start, const Move &feed,
           Motions &motions) {
  if (!(passes.step > 0) || !(passes.retract >= 0))
    return false;
  size_t looks = 0;
  if (passes.across)
    profile.turn();
  profile.lead();
  if (profile.first().x() > profile.start().x())
    profile.setStart({profile.first().x(), profile.start().y()});
  if (!profile.isSteady() || !profile.keepDistance(passes.lastDistance, looks))
    return false;
  profile.closeAt(profile.start().y());
  Pen pen(profile, start, feed, passes.unit, motions);
  pen.rapid(profile.start());
  return Roughing(passes, profile, pen).run();
}

std::optional<Point> endOf(const Move &move, double unit) {
  const Interval &z = move.to[size_t(Axis::Z)], &x = move.to[size_t(Axis::X)];
  if (!z.isConstant() || !x.isConstant() || move.machineAxes)
    return std::nullopt;
  return Point(z.value(), x.value()) / unit;
}

/// The contour's pieces, from its first point on; none where a coordinate is not known.
ProfilePieces piecesOf(llvm::ArrayRef<Move> contour, double unit) {
  ProfilePieces pieces;
  auto from = endOf(contour.front(), unit);
  for (const Move &move : contour.drop_front()) {
    const auto to = endOf(move, unit);
    if (!from || !to)
      return {};
    if (*from == *to)
      continue;
    ProfilePiece piece{*from, *to};
    if (move.kind == MoveKind::Arc) {
      if (!move.centre[0].isConstant() || !move.centre[1].isConstant())
        return {};
      piece.arc = true;
      piece.centre = Point(move.centre[0].value(), move.centre[1].value()) / unit;
      piece.counterClockwise = !move.clockwise;
      if (move.plane[0] != Axis::Z) {
        std::swap(piece.centre.x(), piece.centre.y());
        piece.counterClockwise = move.clockwise;
      }
    }
    pieces.push_back(piece);
    from = to;
  }
  return pieces;
}

} // namespace

bool profilePasses(const ProfilePasses &passes, const Move &start, const Move &feed,
                   llvm::ArrayRef<Move> contour, llvm::function_ref<void(const Move &)> give) {
  const auto begin = endOf(start, passes.unit);
  if (!begin || contour.empty())
    return false;
  ProfilePieces pieces = piecesOf(contour, passes.unit);
  if (pieces.empty())
    return false;
  const FramedProfile profile(*begin, std::move(pieces));
  Motions motions{start};
  if (!(passes.finishing ? finish : rough)(passes, profile, start, feed, motions))
    return false;
  llvm::for_each(motions, give);
  return true;
}

} // namespace ncvet
