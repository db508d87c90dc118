// Puts the corners between two moves where the program asks for them.
#include "interp/corner_path.h"

#include "interp/arc.h"
#include "interp/execute.h"

#include <Eigen/Core>
#include <Eigen/LU>

#include <cmath>
#include <numbers>

namespace ncvet {

namespace {

using Vector = Eigen::Vector2d;

constexpr double radians = std::numbers::pi / 180;
/// Directions are parallel when their sine is below this.
constexpr double parallel = 1e-9;
constexpr double turnTolerance = 1e-9;

Vector left(const Vector &v) { return {-v.y(), v.x()}; }
double cross(const Vector &a, const Vector &b) { return a.x() * b.y() - a.y() * b.x(); }

/// Where two lines meet, each by a point and a direction.
std::optional<Vector> intersection(const Vector &p, const Vector &d, const Vector &q,
                                   const Vector &e) {
  const double sine = cross(d, e);
  if (std::fabs(sine) < parallel)
    return std::nullopt;
  return Vector(p + d * (cross(q - p, e) / sine));
}

/// A straight line or an arc in a plane, lengths in millimetres.
struct Element {
  Vector from, to, centre;
  bool arc = false, clockwise = false;

  double radius() const { return (from - centre).norm(); }
  /// Direction of travel at a point of the element.
  Vector direction(const Vector &at) const {
    if (!arc)
      return (to - from).normalized();
    const Vector turn = left((at - centre).normalized());
    return clockwise ? Vector(-turn) : turn;
  }
};

/// Points at the distance `offset` to the left of both elements that lie nearest to `corner`.
std::optional<Vector> centreBeside(const Element &a, const Element &b, double offset,
                                   const Vector &corner) {
  const auto radiusOf = [&](const Element &e) { // of the circle beside an arc
    return e.radius() + (e.clockwise ? offset : -offset);
  };
  const auto nearest = [&](const Vector &p, const Vector &q) {
    return (p - corner).norm() < (q - corner).norm() ? p : q;
  };
  if (!a.arc && !b.arc) {
    const Vector d = a.direction(a.from), e = b.direction(b.from);
    return intersection(a.from + left(d) * offset, d, b.from + left(e) * offset, e);
  }
  if (a.arc != b.arc) {
    const Element &line = a.arc ? b : a, &arc = a.arc ? a : b;
    const Vector d = line.direction(line.from), p = line.from + left(d) * offset;
    const double r = radiusOf(arc), along = d.dot(arc.centre - p);
    const Vector foot = p + d * along;
    const double square = r * r - (arc.centre - foot).squaredNorm();
    if (r <= 0 || square < 0)
      return std::nullopt;
    const Vector half = d * std::sqrt(square);
    return nearest(foot + half, foot - half);
  }
  const double r = radiusOf(a), s = radiusOf(b);
  const Vector between = b.centre - a.centre;
  const double distance = between.norm();
  if (r <= 0 || s <= 0 || distance < turnTolerance)
    return std::nullopt;
  const double along = (r * r - s * s + distance * distance) / (2 * distance);
  const double square = r * r - along * along;
  if (square < 0)
    return std::nullopt;
  const Vector unit = between / distance, foot = a.centre + unit * along;
  const Vector half = left(unit) * std::sqrt(square);
  return nearest(foot + half, foot - half);
}

/// The point of an element that is nearest to `centre` beside it.
Vector touchPoint(const Element &e, const Vector &centre) {
  if (e.arc)
    return e.centre + (centre - e.centre).normalized() * e.radius();
  const Vector d = e.direction(e.from);
  return e.from + d * d.dot(centre - e.from);
}

double turnsOf(const Vector &from, const Vector &to, const Vector &centre, bool clockwise) {
  const double a = std::atan2(from.y() - centre.y(), from.x() - centre.x());
  const double b = std::atan2(to.y() - centre.y(), to.x() - centre.x());
  double turns = (clockwise ? a - b : b - a) / (2 * std::numbers::pi);
  turns -= std::floor(turns);
  return turns < turnTolerance ? 1 : turns;
}

/// Places between the coordinates of moves and the plane, where X of a lathe is a radius.
class Plane {
public:
  Plane(const Dialect &dialect, const std::array<Axis, 2> &axes) : axes_(axes) {
    for (size_t i = 0; i < 2; ++i)
      factor_[i] = dialect.lengthsPerUnit(axes[i]);
  }
  std::optional<Vector> point(const Place &place) const {
    Vector result;
    for (size_t i = 0; i < 2; ++i) {
      const Interval &x = place[size_t(axes_[i])];
      if (!x.isConstant())
        return std::nullopt;
      result(int(i)) = x.value() / factor_[i];
    }
    return result;
  }
  /// What is known of a point.
  std::array<std::optional<double>, 2> partly(const Place &place) const {
    std::array<std::optional<double>, 2> result;
    for (size_t i = 0; i < 2; ++i)
      if (const Interval &x = place[size_t(axes_[i])]; x.isConstant())
        result[i] = x.value() / factor_[i];
    return result;
  }
  uint16_t bit(size_t i) const { return uint16_t(1u << unsigned(axes_[i])); }
  void set(Place &place, const Vector &point) const {
    for (size_t i = 0; i < 2; ++i)
      place[size_t(axes_[i])] = Interval::exactly(point(int(i)) * factor_[i]);
  }
  std::optional<Element> element(const Place &from, const Move &move) const {
    const auto begin = point(from), end = point(move.to);
    if (!begin || !end || move.machineAxes)
      return std::nullopt;
    Element element{*begin, *end, {}, move.kind == MoveKind::Arc, move.clockwise};
    if (element.arc) {
      if (!move.centre[0].isConstant() || !move.centre[1].isConstant())
        return std::nullopt;
      element.centre = {move.centre[0].value() / factor_[0], move.centre[1].value() / factor_[1]};
    } else if ((*end - *begin).norm() < turnTolerance) {
      return std::nullopt;
    }
    return element;
  }
  /// An arc gets its angle anew when its ends have moved.
  void retrim(Move &move, const Place &from) const {
    if (const auto e = element(from, move); e && e->arc)
      move.turns = Interval::exactly(turnsOf(e->from, e->to, e->centre, e->clockwise));
  }
  Move arc(const Move &like, const Vector &from, const Vector &to, const Vector &centre,
           bool clockwise) const {
    Move move = like;
    move.kind = MoveKind::Arc;
    set(move.to, to);
    move.plane = axes_;
    for (size_t i = 0; i < 2; ++i)
      move.centre[i] = Interval::exactly(centre(int(i)) * factor_[i]);
    move.clockwise = clockwise;
    move.turns = Interval::exactly(turnsOf(from, to, centre, clockwise));
    return move;
  }

private:
  std::array<Axis, 2> axes_;
  std::array<double, 2> factor_{1, 1};
};

bool isCut(const Move &move) { return move.kind == MoveKind::Linear || move.kind == MoveKind::Arc; }

Vector directionOf(double degrees) {
  return {std::cos(degrees * radians), std::sin(degrees * radians)};
}

/// The way of a line by its angle: the words tell which of the two directions is meant.
Vector directionAlong(const Plane &plane, const CornerRequest &line, const Vector &from) {
  const Vector direction = directionOf(*line.angle);
  const auto partly = plane.partly(line.said);
  for (int i = 0; i < 2; ++i)
    if (line.axes & plane.bit(size_t(i)) && partly[size_t(i)] &&
        (*partly[size_t(i)] - from(i)) * direction(i) < 0)
      return -direction;
  return direction;
}

/// Intersections of a circle with a line, in the order in which the line meets them.
std::optional<std::array<Vector, 2>> meetings(const Element &circle, const Vector &point,
                                              const Vector &direction) {
  const double along = direction.dot(circle.centre - point);
  const Vector foot = point + direction * along;
  const double square = circle.radius() * circle.radius() - (circle.centre - foot).squaredNorm();
  if (square < 0)
    return std::nullopt;
  const Vector half = direction * std::sqrt(square);
  return std::array<Vector, 2>{foot - half, foot + half};
}

/// Where the first of two moves ends, when its own words do not say: by its angle, or where it
/// meets the second one, of which angle and end are told.
template <typename Waiting>
std::optional<Vector> endOf(const Plane &plane, const Place &begin, const Waiting &first,
                            const Waiting &second) {
  const auto from = plane.point(begin);
  const auto said = plane.partly(first.corner.said);
  const auto target = plane.point(second.corner.said);
  const uint16_t both = plane.bit(0) | plane.bit(1);
  const bool tells = second.corner.angle && (second.corner.axes & both) == both && target;
  if (first.move.kind == MoveKind::Arc) {
    const auto circle = plane.element(begin, first.move);
    if (!tells || !circle)
      return std::nullopt;
    const auto points = meetings(*circle, *target, directionOf(*second.corner.angle));
    return points ? std::optional((*points)[second.corner.farther ? 1 : 0]) : std::nullopt;
  }
  if (!first.corner.angle || plane.point(first.move.to) || !from)
    return std::nullopt;
  const Vector direction = directionOf(*first.corner.angle);
  if (tells)
    return intersection(*from, direction, *target, directionOf(*second.corner.angle));
  if ((first.corner.axes & both) == both && said[0] && said[1])
    return Vector(*said[0], *said[1]);
  for (int i = 0; i < 2; ++i)
    if (first.corner.axes & plane.bit(size_t(i)) && said[size_t(i)] &&
        std::fabs(direction(i)) > parallel)
      return Vector(*from + direction * ((*said[size_t(i)] - (*from)(i)) / direction(i)));
  return std::nullopt;
}

} // namespace

CornerWords::CornerWords(const Dialect &dialect) {
  AddressMask takes = 0;
  for (const CodeInfo &code : dialect.codes)
    if (code.action == Action::Linear)
      takes |= code.takes;
  legs_ = takes & maskOf(commaC);
  rounding_ = takes & maskOf(commaR);
  angle_ = (takes & maskOf(commaA)) | dialect.lineAngleWords;
  // A lathe's line takes I, K, C, R and A for itself; on a mill these are other words.
  if (dialect.isLathe()) {
    const auto plain = [&](AddressMask letters) {
      AddressMask result = 0;
      for (unsigned i = 0; i < 26; ++i)
        if ((takes & letters) >> i & 1 && dialect.addresses[i].kind == AddressKind::Parameter)
          result |= maskOf(AddressId(i));
      return result;
    };
    legs_ |= plain(lettersMask("IKC"));
    rounding_ |= plain(maskOf('R'));
    angle_ |= plain(maskOf('A'));
  }
  for (unsigned i = 0; i < addressCount; ++i)
    if (const AddressInfo &info = dialect.addresses[i]; info.corner)
      (info.rounding ? rounding_ : info.acrossCorner ? across_ : legs_) |= maskOf(AddressId(i));
  all_ = legs_ | across_ | rounding_ | angle_;
}

CornerRequest CornerWords::read(const ExecutedBlock &executed) const {
  CornerRequest request;
  const Block &block = executed.block;
  request.said = executed.after.position;
  request.axes = axesOf(executed.dialect, block);
  request.shifts = executed.outcome.kinds & bitOf(EventKind::CoordinateChange);
  if (!block.hasAny(all_))
    return request;
  const CodeInfo *motion = executed.after.activeCode(executed.dialect, StandardGroup::Motion);
  if (!motion || !(motion->action == Action::Linear || isArc(motion->action)))
    return request;
  const bool line = motion->action == Action::Linear;
  // In an arc's block these letters are its own.
  const AddressMask own = line ? 0 : lettersMask("IJKRAC");
  const auto length = [&](AddressMask mask) -> std::optional<double> {
    const Word *word = block.findAny(mask & ~own);
    if (!word)
      return std::nullopt;
    const Interval v = lengthOf(*word, block, executed.dialect, executed.machine, executed.after);
    return v.isConstant() && v.value() != 0 ? std::optional(std::fabs(v.value())) : std::nullopt;
  };
  if (const auto radius = length(rounding_)) {
    request.kind = CornerRequest::Kind::Rounding;
    request.size = *radius;
  } else if (const auto across = length(across_)) {
    request.kind = CornerRequest::Kind::Across;
    request.size = *across;
  } else if (const auto legs = length(legs_)) {
    request.kind = CornerRequest::Kind::Legs;
    request.size = *legs;
  }
  if (const Word *word = block.findAny(angle_); word && line && executed.after.frames.empty()) {
    const Interval v = wordValue(*word, block, executed.after);
    if (v.isConstant())
      request.angle = v.value();
    request.said = executed.outcome.via;
  }
  if (const Word *word = block.find(letterAddress('Q'))) {
    const Interval v = wordValue(*word, block, executed.after);
    request.farther = v.isConstant() && v.value() > 0;
  }
  return request;
}

void CornerPath::give(uint64_t tag, const Move &move, Take take) {
  take(tag, move);
  if (move.kind > MoveKind::Thread)
    return;
  const std::array<Axis, 2> axes = move.kind == MoveKind::Arc ? move.plane : plane_;
  if (const auto element = Plane(dialect_, axes).element(from_, move)) {
    const Vector direction = element->direction(element->to);
    direction_ = {direction.x(), direction.y()};
    directionPlane_ = axes;
  }
  from_ = move.to;
}

/// An arc whose start only the path knows, or that goes on in the direction of the move before,
/// gets its centre.
void CornerPath::findCentre(Move &move) const {
  const Plane plane(dialect_, move.plane);
  const auto from = plane.point(from_), to = plane.point(move.to);
  if (!from || !to)
    return;
  if (move.radius) {
    if (const auto centre = centreByRadius({from->x(), from->y()}, {to->x(), to->y()}, *move.radius,
                                           move.clockwise))
      move = plane.arc(move, *from, *to, Vector((*centre)[0], (*centre)[1]), move.clockwise);
    return;
  }
  if (!move.tangential || !direction_ || directionPlane_ != move.plane)
    return;
  const Vector direction((*direction_)[0], (*direction_)[1]), chord = *to - *from;
  const double aside = left(direction).dot(chord);
  if (std::fabs(aside) < parallel)
    return;
  const Vector centre = *from + left(direction) * (chord.squaredNorm() / (2 * aside));
  move = plane.arc(move, *from, *to, centre, aside < 0);
}

void CornerPath::finish(Take take) {
  if (!waiting_)
    return;
  give(waiting_->tag, waiting_->move, take);
  waiting_.reset();
}

/// Coordinates that a block leaves as they are, and that only the path knows.
void CornerPath::carry(Move &move, const CornerRequest &corner) const {
  if (corner.angle)
    return;
  for (unsigned i = 0; i < axisCount; ++i)
    if (resolved_ >> i & 1 && !(corner.axes >> i & 1) && move.to[i].isUnknown())
      move.to[i] = from_[i];
}

void CornerPath::add(uint64_t tag, const Move &move, const CornerRequest &corner,
                     const std::array<Axis, 2> &plane, Take take) {
  const bool moves = move.kind <= MoveKind::Thread;
  Waiting next{tag, move, corner, plane};
  plane_ = plane;
  if (waiting_ && isCut(move) && waiting_->plane == plane)
    resolve(*waiting_, next, take);
  else if (waiting_ && (moves || move.kind == MoveKind::Tool || move.kind == MoveKind::End))
    finish(take);
  if (corner.shifts)
    resolved_ = 0;
  if (moves) {
    carry(next.move, corner);
    for (unsigned i = 0; i < axisCount; ++i)
      if (!move.to[i].isUnknown())
        resolved_ &= ~(1u << i);
  }
  if (next.move.kind == MoveKind::Arc && !next.move.centre[0].isConstant())
    findCentre(next.move);
  if (isCut(next.move) && (corner.kind != CornerRequest::Kind::None || corner.angle)) {
    waiting_ = next;
    return;
  }
  give(next.tag, next.move, take);
}

/// The first move ends where the second one, or the corner between them, begins.
void CornerPath::resolve(Waiting &first, Waiting &second, Take take) {
  const Plane plane(dialect_, first.plane);
  if (const auto end = endOf(plane, from_, first, second)) {
    for (const Axis axis : first.plane)
      if (first.move.to[size_t(axis)].isUnknown())
        resolved_ |= 1u << unsigned(axis);
    plane.set(first.move.to, *end);
    plane.retrim(first.move, from_);
  }
  const Place corner = first.move.to;
  const Place begin = from_;
  from_ = corner;
  carry(second.move, second.corner);
  for (const Axis axis : second.plane) // the words are its end, unless a third move says otherwise
    if (second.corner.axes >> unsigned(axis) & 1 && second.move.to[size_t(axis)].isUnknown() &&
        !second.corner.angle)
      second.move.to[size_t(axis)] = second.corner.said[size_t(axis)];
  from_ = begin;
  if (!putCorner(first, second, take))
    give(first.tag, first.move, take);
  waiting_.reset();
}

/// Chamfer or rounding between two moves; false when there is none, or not enough is known.
bool CornerPath::putCorner(Waiting &first, Waiting &second, Take take) {
  if (first.corner.kind == CornerRequest::Kind::None)
    return false;
  const Plane plane(dialect_, first.plane);
  Move ahead = second.move; // as far as its direction is known
  if (const auto to = plane.point(ahead.to); !to && second.corner.angle)
    if (const auto from = plane.point(first.move.to))
      plane.set(ahead.to, *from + directionAlong(plane, second.corner, *from));
  const auto a = plane.element(from_, first.move), b = plane.element(first.move.to, ahead);
  if (!a || !b)
    return false;
  const Vector meet = a->to, in = a->direction(meet), out = b->direction(meet);
  const double side = cross(in, out); // above zero: the path turns left
  if (std::fabs(side) < parallel)
    return false;
  if (first.corner.kind == CornerRequest::Kind::Rounding) {
    const double offset = side > 0 ? first.corner.size : -first.corner.size;
    const auto centre = centreBeside(*a, *b, offset, meet);
    if (!centre)
      return false;
    const Vector begin = touchPoint(*a, *centre), end = touchPoint(*b, *centre);
    plane.set(first.move.to, begin);
    plane.retrim(first.move, from_);
    give(first.tag, first.move, take);
    give(first.tag, plane.arc(first.move, begin, end, *centre, side < 0), take);
    plane.retrim(second.move, from_);
    return true;
  }
  if (a->arc || b->arc)
    return false;
  const double legs = first.corner.kind == CornerRequest::Kind::Legs
                          ? first.corner.size
                          : first.corner.size / std::sqrt(2 + 2 * in.dot(out));
  Move chamfer = first.move;
  plane.set(first.move.to, meet - in * legs);
  give(first.tag, first.move, take);
  plane.set(chamfer.to, meet + out * legs);
  give(first.tag, chamfer, take);
  return true;
}

} // namespace ncvet
