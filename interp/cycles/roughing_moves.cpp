// The passes of turning cycles along a contour: parallel to an axis down to the contour, the
// contour shifted again and again, the path back.
#include "interp/cycles/contour_cycle.h"
#include "interp/geometry/circle.h"
#include "interp/geometry/turned_contour.h"

#include <cmath>

namespace ncvet {

namespace {

constexpr size_t atZ = 0, atX = 1;         ///< in points of the contour
constexpr unsigned mostPasses = 10000;     ///< more are an error that rules report
constexpr double roughingTolerance = 1e-7; ///< mm

using Give = llvm::function_ref<void(const Move &)>;

void shiftBy(Move &move, const std::array<std::optional<double>, 2> &by,
             const std::array<double, 2> &lengths) {
  constexpr Axis axes[] = {Axis::X, Axis::Z};
  for (size_t i = 0; i < 2; ++i) {
    const Interval off = by[i] ? Interval::exactly(*by[i] * lengths[i]) : Interval::unknown();
    Interval &to = move.to[size_t(axes[i])];
    to = to + off;
    for (size_t k = 0; move.kind == MoveKind::Arc && k < 2; ++k)
      if (move.plane[k] == axes[i])
        move.centre[k] = move.centre[k] + off;
  }
}

/// Writes the motions of one roughing cycle.
class Roughing {
public:
  Roughing(const ContourCycle &cycle, llvm::ArrayRef<Move> contour, Give give)
      : cycle_(cycle), moves_(contour), at_(cycle.start), give_(give),
        infeed_(cycle.kind == CycleKind::RoughFace ? atZ : atX), along_(1 - infeed_) {
    at_.machineAxes = 0;
  }

  void run() {
    if (cycle_.kind == CycleKind::PatternRepeat)
      return repeat();
    if (cycle_.rest[0] && cycle_.rest[1] && cycle_.last[0] && cycle_.last[1])
      levels();
    if (cycle_.last[0] != 0 || cycle_.last[1] != 0) {
      alongContour(total());
      backToStart(cycle_.rest);
    }
    alongContour(cycle_.rest);
  }

private:
  std::array<std::optional<double>, 2> total() const {
    std::array<std::optional<double>, 2> sum;
    for (size_t i = 0; i < 2; ++i)
      if (cycle_.rest[i] && cycle_.last[i])
        sum[i] = *cycle_.rest[i] + *cycle_.last[i];
    return sum;
  }
  static Axis axisOf(size_t index) { return index == atZ ? Axis::Z : Axis::X; }
  double lengthsOf(size_t index) const { return cycle_.lengths[index == atZ ? 1 : 0]; }

  void give(const Move &move) {
    if (++given_ <= mostContourMoves)
      give_(move);
  }
  void go(MoveKind kind) {
    Move move = kind == MoveKind::Rapid ? cycle_.start : cycle_.feed;
    move.kind = kind;
    move.to = at_.to;
    move.machineAxes = 0;
    give(move);
  }
  void set(size_t index, double value) {
    at_.to[size_t(axisOf(index))] = Interval::exactly(value * lengthsOf(index));
  }
  void go(MoveKind kind, const Point &to) {
    set(atZ, to[atZ]);
    set(atX, to[atX]);
    go(kind);
  }

  /// The contour's motions moved aside, at the cycle's feed.
  void alongContour(const std::array<std::optional<double>, 2> &by) {
    for (Move move : moves_) {
      shiftBy(move, by, cycle_.lengths);
      if (move.kind != MoveKind::Rapid) {
        move.feed = cycle_.feed.feed;
        move.feedMode = cycle_.feed.feedMode;
      }
      at_.to = move.to;
      give(move);
    }
  }
  void backToStart(const std::array<std::optional<double>, 2> &by) {
    Move start = cycle_.start;
    shiftBy(start, by, cycle_.lengths);
    at_.to = start.to;
    go(MoveKind::Rapid);
  }

  /// The whole contour from far to near.
  void repeat() {
    const double passes = cycle_.passes ? std::floor(*cycle_.passes) : 0;
    for (double pass = 0; pass < passes && pass < mostPasses && given_ < mostContourMoves; ++pass) {
      std::array<std::optional<double>, 2> by;
      for (size_t i = 0; i < 2; ++i)
        if (cycle_.rest[i] && cycle_.way[i])
          by[i] = *cycle_.rest[i] +
                  (passes > 1 ? *cycle_.way[i] * (passes - 1 - pass) / (passes - 1) : 0);
      backToStart(by);
      alongContour(by);
    }
  }

  /// Contour without what leads away from it at its end.
  llvm::ArrayRef<Move> shape() const {
    llvm::ArrayRef<Move> shape = moves_;
    while (shape.size() > 1 && shape.back().kind == MoveKind::Rapid)
      shape = shape.drop_back();
    return shape;
  }

  /// Passes side by side, each deeper than the one before by the depth of cut.
  void levels() {
    TurnedContour contour(shape(), cycle_.lengths[0]);
    const Interval &x = cycle_.start.to[size_t(Axis::X)], &z = cycle_.start.to[size_t(Axis::Z)];
    if (!contour.known() || !contour.isSteady(along_) || !cycle_.depth ||
        std::fabs(*cycle_.depth) < roughingTolerance || !x.isConstant() || !z.isConstant())
      return;
    const auto by = total();
    const Point shift{*by[1], *by[0]};
    contour.shift(shift);
    contour_ = &contour;
    start_ = {z.value() / lengthsOf(atZ) + shift[atZ], x.value() / lengthsOf(atX) + shift[atX]};
    const double in = contour.first()[infeed_] - start_[infeed_];
    const double forward = contour.last()[along_] - contour.first()[along_];
    if (std::fabs(in) < roughingTolerance || std::fabs(forward) < roughingTolerance)
      return;
    in_ = in < 0 ? -1 : 1;
    forward_ = forward < 0 ? -1 : 1;
    if (shift[0] != 0 || shift[1] != 0)
      go(MoveKind::Rapid, start_);
    const double step = std::fabs(*cycle_.depth);
    const double deepest = contour.farthest(infeed_, in_, contour.whole());
    double above = start_[infeed_];
    for (unsigned pass = 0; pass < mostPasses && given_ < mostContourMoves; ++pass) {
      const double level = start_[infeed_] + in_ * step * (pass + 1);
      // What lies between this level and the one before is cut at its own depth.
      if (pass == 0)
        bottoms(contour.whole(), above, level);
      else
        for (const auto &part : contour.beyond(infeed_, above, in_))
          bottoms(part, above, level);
      if ((deepest - level) * in_ < -roughingTolerance)
        break;
      for (const auto &part : contour.beyond(infeed_, level, in_))
        cut(part, level, above);
      above = level;
    }
  }

  /// The bottom of a part that ends before the next level.
  void bottoms(const TurnedContour::Part &part, double above, double level) {
    const double bottom = contour_->farthest(infeed_, in_, part);
    if ((bottom - above) * in_ <= roughingTolerance || (bottom - level) * in_ > -roughingTolerance)
      return;
    for (const auto &piece : contour_->beyond(infeed_, bottom, in_, &part))
      cut(piece, bottom, above);
  }

  /// One pass at `level`; the one before was at `above`.
  void cut(const TurnedContour::Part &part, double level, double above) {
    Point from = part.from, to = part.to;
    if (part.fromBegin)
      from[along_] = start_[along_];
    if ((to[along_] - from[along_]) * forward_ <= roughingTolerance)
      return;
    from[infeed_] = to[infeed_] = level;
    const MoveKind in = moves_.front().kind == MoveKind::Rapid ? MoveKind::Rapid : MoveKind::Linear;
    const double clear = clearOf(part, above);
    if (!part.fromBegin) {
      lift(clear);
      set(along_, from[along_]);
      go(MoveKind::Rapid);
      go(MoveKind::Linear, from);
    } else {
      go(in, from);
    }
    go(MoveKind::Linear, to);
    if (follows() && !part.toEnd)
      to = follow(part, to, above);
    retract(from, to);
    if (!part.fromBegin)
      lift(clear);
    set(along_, start_[along_]);
    go(MoveKind::Rapid);
  }

  /// Level above all that is between the begin of the passes and the part.
  double clearOf(const TurnedContour::Part &part, double above) const {
    TurnedContour::Part way = contour_->whole();
    way.lastPiece = part.firstPiece;
    way.to = part.from;
    const double highest = contour_->farthest(infeed_, -in_, way);
    return (highest - above) * in_ < 0 ? highest : above;
  }
  void lift(double clear) {
    at_.to[size_t(axisOf(infeed_))] =
        (Interval::exactly(clear) - cycle_.retract * in_) * lengthsOf(infeed_);
    go(MoveKind::Rapid);
  }

  /// Away from the work at 45 degrees, but not after the begin of the pass.
  void retract(const Point &from, const Point &to) {
    const Interval &way = cycle_.retract;
    if (way.isConstant()) {
      Point place = to;
      place[infeed_] -= in_ * way.value();
      place[along_] -= forward_ * std::min(way.value(), std::fabs(to[along_] - from[along_]));
      return go(MoveKind::Rapid, place);
    }
    at_.to[size_t(Axis::X)] = at_.to[size_t(Axis::Z)] = Interval::unknown();
    go(MoveKind::Rapid);
  }

  bool follows() const { return cycle_.bothAxes && cycle_.has(CycleTrait::FollowsContour); }

  /// Along the contour from the end of a pass to the level of the pass before.
  Point follow(const TurnedContour::Part &part, Point at, double above) {
    const auto pieces = contour_->pieces();
    for (size_t i = part.lastPiece; i < pieces.size(); ++i) {
      const ContourPiece &piece = pieces[i];
      const bool leaves = (piece.to[infeed_] - above) * in_ <= roughingTolerance;
      const bool falls = (piece.to[infeed_] - at[infeed_]) * in_ > roughingTolerance;
      if (falls)
        return at;
      Point end = leaves ? piece.at(infeed_, above) : piece.to;
      if (distance(at, end) > roughingTolerance)
        alongPiece(piece, at, end);
      at = end;
      if (leaves)
        break;
    }
    return at;
  }
  void alongPiece(const ContourPiece &piece, const Point &from, const Point &to) {
    set(atZ, to[atZ]);
    set(atX, to[atX]);
    if (!piece.arc)
      return go(MoveKind::Linear);
    Move move = cycle_.feed;
    move.kind = MoveKind::Arc;
    move.to = at_.to;
    move.plane = {Axis::Z, Axis::X};
    move.centre = {Interval::exactly(piece.centre[atZ] * lengthsOf(atZ)),
                   Interval::exactly(piece.centre[atX] * lengthsOf(atX))};
    move.clockwise = piece.clockwise;
    move.turns = Interval::exactly(turnsOverChord(distance(from, to), piece.radius));
    give(move);
  }

  const ContourCycle &cycle_;
  const llvm::ArrayRef<Move> moves_;
  Move at_; ///< where the tool is
  const Give give_;
  const size_t infeed_, along_;
  const TurnedContour *contour_ = nullptr; ///< moved to where roughing ends
  Point start_ = Point::Zero();            ///< of the passes
  double in_ = -1, forward_ = -1;          ///< signs of infeed and cut
  size_t given_ = 0;
};

} // namespace

void shiftByRest(const ContourCycle &cycle, Move &move) {
  shiftBy(move, cycle.rest, cycle.lengths);
}

void roughContour(const ContourCycle &cycle, llvm::ArrayRef<Move> contour, Give give) {
  if (!contour.empty())
    Roughing(cycle, contour, give).run();
}

void returnToStart(const ContourCycle &cycle, const Place &from, Give give) {
  Move move = cycle.start;
  if (cycle.has(CycleTrait::ReturnsByAxes)) {
    const Interval &start = cycle.start.to[size_t(Axis::X)], &end = from[size_t(Axis::X)];
    Move first = move;
    if (!start.isConstant() || !end.isConstant())
      first.to[size_t(Axis::X)] = first.to[size_t(Axis::Z)] = Interval::unknown();
    else if (start.value() < end.value())
      first.to[size_t(Axis::X)] = end;
    else
      first.to[size_t(Axis::Z)] = from[size_t(Axis::Z)];
    give(first);
  }
  give(move);
}

} // namespace ncvet
