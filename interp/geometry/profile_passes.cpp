// Passes along a turned contour: the frame in which it climbs, its distance, and the levels.
#include "interp/geometry/profile_passes.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/ADT/SmallVector.h"
#include <Eigen/Core>

#include <cmath>
#include <numbers>
#include <optional>

namespace ncvet {

namespace {

using Point =
    Eigen::Vector2d; ///< along the cut and away from the axis; Z and X as a radius, turned
using Motions = llvm::SmallVector<Move, 0>;

// The interpreter's own: below them points are one, pieces are gone, a contour does not turn back.
constexpr double samePoint = 1e-6;
constexpr double sameArcEnd = 1e-3;
constexpr double shortest = 1e-3;
constexpr double turnsBack = 1e-3;
constexpr double noLength = 1e-12;
constexpr double atTop = 1e-9;       ///< of an arc, or at its bottom
constexpr double widestGap = 1e-2;   ///< between two pieces that are led to their intersection
constexpr size_t mostMoves = 200000; ///< of one cycle: no program is followed without end
/// Looks at pieces that one cycle may cost: a contour of many pieces takes as long as any other.
constexpr size_t mostLooks = 20000000;

double cross(const Point &a, const Point &b) { return a.x() * b.y() - a.y() * b.x(); }

/// A line or an arc of the contour.
struct Piece {
  Point from, to;
  bool arc = false;
  bool counterClockwise = false;
  Point centre{0, 0};

  double radius() const { return (from - centre).norm(); }
  /// What the piece may lose before noLength is left of it.
  double size() const {
    const double chord = (to - from).norm();
    return arc ? std::min(chord, radius()) : chord;
  }
  /// Whether it leads in the direction of the cut all the way.
  bool isSteady() const {
    const double way = to.x() - from.x();
    if (!arc)
      return way <= turnsBack;
    const double sign = counterClockwise ? 1 : -1;
    return way <= -turnsBack && sign * (from.y() - centre.y()) >= -turnsBack &&
           sign * (to.y() - centre.y()) >= -turnsBack;
  }
  bool spans(const Point &point) const {
    const double sign = counterClockwise ? 1 : -1;
    return sign * cross(from - centre, point - centre) >= -samePoint &&
           sign * cross(to - centre, point - centre) <= samePoint;
  }
  /// Where it has this height: none, one or two places along the cut.
  llvm::SmallVector<double, 2> at(double height) const {
    llvm::SmallVector<double, 2> places;
    if (arc) {
      const double r = radius(), off = height - centre.y();
      const double square = r * r - off * off;
      if (square < -samePoint)
        return places;
      const double half = std::sqrt(std::max(0.0, square));
      for (const double place : {centre.x() + half, centre.x() - half})
        if (spans({place, height}))
          places.push_back(place);
      return places;
    }
    const auto [low, high] = std::minmax(from.y(), to.y());
    if (low > height + samePoint || high < height - samePoint)
      return places;
    if (high - low < samePoint)
      places.append({from.x(), to.x()});
    else
      places.push_back(from.x() + (height - from.y()) / (to.y() - from.y()) * (to.x() - from.x()));
    return places;
  }
  /// Parallel, on the left of its path for a distance above zero when it is a line.
  void offset(double distance) {
    if (!arc) {
      const Point back = (from - to).normalized();
      const Point side = distance * Point(-back.y(), back.x());
      from += side;
      to += side;
      return;
    }
    const double factor = (radius() + (counterClockwise ? distance : -distance)) / radius();
    from = centre + factor * (from - centre);
    to = centre + factor * (to - centre);
  }
};

using Pieces = llvm::SmallVector<Piece, 16>;

/// Where the line through `line` meets the circle of `arc`, nearest to `near`.
Point lineWithCircle(const Piece &line, const Piece &arc, const Point &near) {
  const Point along = (line.to - line.from).normalized();
  const Point foot = line.from + along * along.dot(arc.centre - line.from);
  const double off = (foot - arc.centre).norm(), r = arc.radius();
  const double half = std::sqrt(std::max(0.0, r * r - off * off));
  const Point one = foot + half * along, other = foot - half * along;
  return (one - near).norm() < (other - near).norm() ? one : other;
}

/// Leads the end of `a` and the begin of `b` to where the two meet; false: they never do.
bool meet(Piece &a, Piece &b) {
  if (!a.arc && !b.arc) {
    const Point u = a.to - a.from, v = b.to - b.from;
    const double turn = cross(u, v);
    if (turn == 0)
      return false;
    a.to = b.from = a.from + cross(b.from - a.from, v) / turn * u;
    return true;
  }
  if (a.arc != b.arc) {
    if ((a.to - b.from).norm() >= samePoint)
      a.to = b.from = a.arc ? lineWithCircle(b, a, b.from) : lineWithCircle(a, b, b.from);
    return true;
  }
  if (a.counterClockwise != b.counterClockwise)
    return true;
  const Point between = a.centre - b.centre;
  const double c = between.norm();
  if (c == 0)
    return true;
  const double ra = b.radius(), rb = a.radius();
  const double cosine = (c * c + ra * ra - rb * rb) / (2 * ra * c);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const Point e = between / c;
  a.to = b.from =
      b.centre + ra * Point(cosine * e.x() - sine * e.y(), sine * e.x() + cosine * e.y());
  return true;
}

/// A contour after the path to it, in the frame in which it leads in the direction of -1, up.
class Profile {
public:
  Profile(const Point &start, Pieces pieces) : start_(start), pieces_(std::move(pieces)) {}

  const Point &start() const { return start_; }
  void setStart(const Point &start) { start_ = start; }
  const Point &first() const { return pieces_.front().from; }
  const Pieces &pieces() const { return pieces_; }
  bool isSteady() const {
    return llvm::all_of(pieces_, [](const Piece &piece) { return piece.isSteady(); });
  }
  /// Whether the path to the contour leads in that direction too.
  bool beginsSteady() const { return Piece{start_, first()}.isSteady(); }
  /// By a quarter turn: levels across are levels along.
  void turn() {
    map([](const Point &p) { return Point(p.y(), -p.x()); }, /*mirrors=*/false);
    turned_ = !turned_;
  }
  /// Mirrored so that it climbs in the direction of the cut.
  void lead() {
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
  /// Z and X of a point of this frame.
  Point inWorkpiece(Point p) const {
    if (flippedAlong_)
      p.x() = -p.x();
    if (flippedUp_)
      p.y() = -p.y();
    return turned_ ? Point(-p.y(), p.x()) : p;
  }
  bool isMirrored() const { return flippedAlong_ != flippedUp_; }

  /// The contour that runs at this distance, on the side of the start; false: none can be made.
  /// `looks` counts those at pieces.
  bool keepDistance(double distance, size_t &looks) {
    lead();
    const Point toFirst = first() - start_, toLast = pieces_.back().from - start_;
    if (cross(toLast, toFirst) < 0)
      distance = -distance;
    for (double done = 0; !(std::fabs(distance - done) <= noLength);) {
      if ((looks += pieces_.size()) > mostLooks)
        return false;
      double step = std::fabs(distance - done);
      for (const Piece &piece : pieces_)
        step = std::min(step, piece.size() / 2);
      if (!move(distance < 0 ? -step : step))
        return false;
      done += distance < 0 ? -step : step;
    }
    for (size_t i = 0; i + 1 < pieces_.size(); ++i)
      pieces_[i].to = pieces_[i + 1].from = (pieces_[i].to + pieces_[i + 1].from) / 2;
    return true;
  }
  void closeAt(double height) {
    const Point end = pieces_.back().to;
    if (end.y() < height)
      pieces_.push_back({end, {end.x(), height}});
  }

private:
  template <typename Map>
  void map(const Map &map, bool mirrors) {
    start_ = map(start_);
    for (Piece &piece : pieces_) {
      piece.from = map(piece.from);
      piece.to = map(piece.to);
      piece.centre = map(piece.centre);
      piece.counterClockwise ^= mirrors;
    }
  }
  /// By so little that no piece vanishes.
  bool move(double step) {
    Pieces moved;
    for (Piece piece : pieces_) {
      piece.offset(step);
      if (piece.size() < shortest)
        continue;
      if (!moved.empty() && moved.back().to.x() - piece.from.x() > widestGap) {
        Piece before = moved.back(), behind = piece;
        before.offset(-step);
        behind.offset(-step);
        moved.push_back(
            {moved.back().to, piece.from, true, step > 0, (before.to + behind.from) / 2});
      }
      moved.push_back(piece);
    }
    for (size_t i = 0; i + 1 < moved.size(); ++i)
      if (!meet(moved[i], moved[i + 1]))
        return false;
    pieces_ = std::move(moved);
    return !pieces_.empty();
  }

  Point start_;
  Pieces pieces_;
  bool turned_ = false, flippedAlong_ = false, flippedUp_ = false;
};

/// Writes motions of a profile's frame.
class Pen {
public:
  Pen(const Profile &profile, const Move &start, const Move &feed, double unit, Motions &motions)
      : profile_(profile), start_(start), feed_(feed), unit_(unit), motions_(motions) {}

  void rapid(const Point &to) { add(start_, to).kind = MoveKind::Rapid; }
  void line(const Point &to) { add(feed_, to).kind = MoveKind::Linear; }
  void arc(const Piece &piece, const Point &to) {
    const Point begin = at_ - piece.centre, end = to - piece.centre;
    Move &move = add(feed_, to);
    move.kind = MoveKind::Arc;
    move.plane = {Axis::Z, Axis::X};
    const Point centre = unit_ * profile_.inWorkpiece(piece.centre);
    move.centre = {Interval::exactly(centre.x()), Interval::exactly(centre.y())};
    move.clockwise = piece.counterClockwise == profile_.isMirrored();
    double turn = std::atan2(cross(begin, end), begin.dot(end)) / (2 * std::numbers::pi);
    if (!piece.counterClockwise)
      turn = -turn;
    move.turns = Interval::exactly(turn > 0 ? turn : turn + 1);
  }
  void along(const Piece &piece) { piece.arc ? arc(piece, piece.to) : line(piece.to); }
  bool isFull() const { return motions_.size() >= mostMoves; }

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

  const Profile &profile_;
  const Move &start_, &feed_;
  const double unit_;
  Motions &motions_;
  Point at_{0, 0};
};

/// Removes what lies between the start and the contour, level by level.
class Roughing {
public:
  Roughing(const ProfilePasses &passes, const Profile &profile, Pen &pen)
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
    const Piece &piece = pieces_[index];
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
  bool divesAlongArc(const Piece &piece, double level) {
    if ((at_ - piece.to).norm() < sameArcEnd)
      return true;
    const double side = at_.x() - piece.centre.x();
    if (piece.counterClockwise ? side > atTop : side <= atTop)
      return false;
    const auto places = piece.at(level);
    const bool reaches =
        !places.empty() && (piece.counterClockwise ? places.back() <= piece.centre.x()
                                                   : places.front() >= piece.centre.x());
    const Point to =
        reaches ? Point(places[piece.counterClockwise ? places.size() - 1 : 0], level) : piece.to;
    if (!reaches || (at_ - to).norm() > sameArcEnd)
      pen_.arc(piece, to);
    at_ = to;
    return true;
  }
  /// Where the arc is at its top, or its end when that comes first.
  static Point topOf(const Piece &piece) {
    if (!piece.counterClockwise || piece.to.x() >= piece.centre.x())
      return piece.to;
    return {piece.centre.x(), piece.centre.y() + piece.radius()};
  }
  /// Goes up along a piece; false where it goes down, at once or after its top.
  bool climbs(const Piece &piece) {
    if (!piece.arc) {
      if (piece.to.y() < piece.from.y())
        return false;
      fits_ &= (at_ - piece.from).norm() <= samePoint;
      pen_.line(piece.to);
      at_ = piece.to;
      return fits_;
    }
    const double side = at_.x() - piece.centre.x();
    if (piece.counterClockwise ? side < -atTop : side > atTop)
      return false;
    const Point to = topOf(piece);
    if ((at_ - to).norm() > sameArcEnd)
      pen_.arc(piece, to);
    at_ = to;
    return !piece.counterClockwise;
  }
  /// Goes straight on to the piece and up along it, where it climbs at all.
  void climbsBehindPockets(const Piece &piece) {
    if (!piece.arc && piece.to.y() < piece.from.y())
      return;
    const auto places = piece.at(at_.y());
    if (places.empty())
      return;
    const double place = piece.arc && !piece.counterClockwise ? places.back() : places.front();
    const double side = piece.arc ? place - piece.centre.x() : 0;
    if (piece.arc && (piece.counterClockwise ? side < -atTop : side > atTop))
      return;
    at_.x() = place;
    pen_.line(at_);
    const Point to = piece.arc ? topOf(piece) : piece.to;
    if (!piece.arc)
      pen_.line(to);
    else if ((at_ - to).norm() > sameArcEnd)
      pen_.arc(piece, to);
    at_ = to;
  }

  /// Cuts what lies before `piece` and after it down to where the contour climbs again, and
  /// follows it up to the next pocket, whose first piece is the answer.
  size_t pocket(size_t piece, bool around) {
    double level = top_;
    while (piece < pieces_.size() && fits_ && ++looks_ < mostLooks && !pen_.isFull()) {
      while (level > at_.y() && ++looks_ < mostLooks)
        level -= passes_.step;
      if (!dives(piece, level)) {
        for (; fits_ && piece < pieces_.size(); ++piece)
          if (around)
            climbsBehindPockets(pieces_[piece]);
          else if (!climbs(pieces_[piece]))
            return piece;
        return piece;
      }
      if (at_.y() > level || std::fabs(at_.y() - level) > samePoint)
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
      if (++looks_ > mostLooks)
        break;
      if (places.empty())
        continue;
      const double place = next == piece ? places.back() : places.front();
      const double way = std::fabs(place - at_.x());
      if (way < samePoint) {
        if (next == piece)
          continue;
        // There is noLength to cut here.
        if ((at_ - pieces_[piece].to).norm() < samePoint)
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
    fits_ = false; // noLength stops the cut
    return piece;
  }

  const ProfilePasses &passes_;
  Pen &pen_;
  const double top_;
  Point at_;
  Pieces pieces_; ///< the path from the start to the contour first
  bool fits_ = true;
  size_t looks_ = 0;
};

bool finish(const ProfilePasses &passes, Profile profile, const Move &start, const Move &feed,
            Motions &motions) {
  constexpr double mostPasses = 10000;
  if (!(passes.count >= 0 && passes.count <= mostPasses))
    return false;
  size_t looks = 0;
  if (!profile.isSteady() || !profile.beginsSteady())
    profile.turn();
  profile.lead();
  for (auto pass = int(passes.count); pass > 0; --pass) {
    Profile path = profile;
    if (!path.keepDistance((pass - 1) * (passes.firstDistance - passes.lastDistance) /
                                   passes.count +
                               passes.lastDistance,
                           looks))
      return false;
    Pen pen(path, start, feed, passes.unit, motions);
    pen.rapid(path.start());
    pen.rapid(path.first());
    for (const Piece &piece : path.pieces())
      pen.along(piece);
    if (pen.isFull())
      return false;
  }
  return true;
}

bool rough(const ProfilePasses &passes, Profile profile, const Move &start, const Move &feed,
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
Pieces piecesOf(llvm::ArrayRef<Move> contour, double unit) {
  Pieces pieces;
  auto from = endOf(contour.front(), unit);
  for (const Move &move : contour.drop_front()) {
    const auto to = endOf(move, unit);
    if (!from || !to)
      return {};
    if (*from == *to)
      continue;
    Piece piece{*from, *to};
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
  Pieces pieces = piecesOf(contour, passes.unit);
  if (pieces.empty())
    return false;
  const Profile profile(*begin, std::move(pieces));
  Motions motions{start};
  if (!(passes.finishing ? finish : rough)(passes, profile, start, feed, motions))
    return false;
  llvm::for_each(motions, give);
  return true;
}

} // namespace ncvet
