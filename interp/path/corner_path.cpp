// Puts the corners between two moves where the program asks for them.
#include "interp/path/corner_path.h"

#include "interp/evaluate/block_words.h"
#include "interp/evaluate/expression.h"
#include "interp/geometry/contour_element.h"
#include "interp/geometry/tolerance.h"
#include "interp/state/modes.h"

namespace ncvet {

namespace {

bool isCut(const Move &move) { return move.kind == MoveKind::Linear || move.kind == MoveKind::Arc; }

Vector directionOf(double degrees) { return unitVector(radiansOf(degrees)); }

/// The direction of a line by its angle: the words tell which of the two directions is meant.
Vector directionAlong(const ContourPlane &plane, const CornerRequest &line, const Vector &from) {
  const Vector direction = directionOf(*line.angle);
  const auto partly = plane.partly(line.said);
  for (int i = 0; i < 2; ++i)
    if (line.axes & plane.bit(size_t(i)) && partly[size_t(i)] &&
        (*partly[size_t(i)] - from(i)) * direction(i) < 0)
      return -direction;
  return direction;
}

/// Intersections of a circle with a line, in the order in which the line meets them.
std::optional<std::array<Vector, 2>> meetings(const ContourElement &circle, const Vector &point,
                                              const Vector &direction) {
  const Vector foot = footOnLine(point, direction, circle.centre);
  const double square = circle.radius() * circle.radius() - (circle.centre - foot).squaredNorm();
  if (square < 0)
    return std::nullopt;
  const Vector half = direction * std::sqrt(square);
  return std::array<Vector, 2>{foot - half, foot + half};
}

/// Where the first of two moves ends, when its own words do not say: by its angle, or where it
/// meets the second one, of which angle and end are told.
template <typename Waiting>
std::optional<Vector> endOf(const ContourPlane &plane, const Place &begin, const Waiting &first,
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
        std::fabs(direction(i)) > Tolerance::parallel)
      return Vector(*from + direction * ((*said[size_t(i)] - (*from)(i)) / direction(i)));
  return std::nullopt;
}

} // namespace

bool isCornerOfAxis(const Dialect &dialect, const Block &block, const MachineState &state) {
  const uint8_t spindle = state.spindle;
  return (axesOf(dialect, block) & planeAxes(dialect, state)) &&
         (spindle == spindleCw || spindle == spindleCcw) &&
         state.activeAction(dialect, StandardGroup::FeedMode) == Action::FeedPerRevolution;
}

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
  AddressMask own = line ? 0 : lettersMask("IJKRAC");
  if (block.hasAny(all_ & executed.dialect.axisWords) &&
      !isCornerOfAxis(executed.dialect, block, executed.after))
    own |= executed.dialect.axisWords;
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
    const Interval v = assignedWordValue(*word, block, executed.after);
    if (v.isConstant())
      request.angle = v.value();
    request.said = executed.outcome.via;
  }
  if (const Word *word = block.find(letterAddress('Q'))) {
    const Interval v = assignedWordValue(*word, block, executed.after);
    request.farther = v.isConstant() && v.value() > 0;
  }
  return request;
}

void CornerPath::give(uint64_t tag, const Move &move, Take take) {
  take(tag, move);
  if (move.kind > MoveKind::Thread)
    return;
  const std::array<Axis, 2> axes = move.kind == MoveKind::Arc ? move.plane : plane_;
  if (travel_.axes() != axes)
    travel_ = ContourPlane(dialect_, axes);
  if (const auto element = travel_.element(from_, move)) {
    const Vector direction = element->direction(element->to);
    direction_ = {direction.x(), direction.y()};
    directionPlane_ = axes;
  }
  from_ = workPlace(move);
}

/// An arc whose start only the path knows, or that goes on in the direction of the move before,
/// gets its centre.
void CornerPath::findCentre(Move &move) const {
  const ContourPlane plane(dialect_, move.plane);
  const auto from = plane.point(from_), to = plane.point(move.to);
  if (!from || !to)
    return;
  if (move.radius) {
    if (const auto centre = centreByRadius(*from, *to, *move.radius, move.clockwise))
      move = plane.arc(move, {*from, *to, *centre, true, move.clockwise});
    return;
  }
  if (!move.tangential || !direction_ || directionPlane_ != move.plane)
    return;
  const Vector direction((*direction_)[0], (*direction_)[1]), chord = *to - *from;
  const double aside = leftOf(direction).dot(chord);
  if (std::fabs(aside) < Tolerance::parallel)
    return;
  const Vector centre = *from + leftOf(direction) * (chord.squaredNorm() / (2 * aside));
  move = plane.arc(move, {*from, *to, centre, true, aside < 0});
}

void CornerPath::finish(Take take) {
  if (!waiting_)
    return;
  give(waiting_->tag, waiting_->move, take);
  waiting_.reset();
}

void CornerPath::resume(const Place &from, const Move &last) {
  from_ = from;
  give(0, last, [](uint64_t, const Move &) {});
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
  const ContourPlane plane(dialect_, first.plane);
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
  const ContourPlane plane(dialect_, first.plane);
  Move ahead = second.move; // as far as its direction is known
  if (const auto to = plane.point(ahead.to); !to && second.corner.angle)
    if (const auto from = plane.point(first.move.to))
      plane.set(ahead.to, *from + directionAlong(plane, second.corner, *from));
  const auto a = plane.element(from_, first.move), b = plane.element(first.move.to, ahead);
  if (!a || !b)
    return false;
  const Vector meet = a->to, in = a->direction(meet), out = b->direction(meet);
  const double side = cross(in, out); // above zero: the path turns left
  if (std::fabs(side) < Tolerance::parallel)
    return false;
  if (first.corner.kind == CornerRequest::Kind::Rounding) {
    const double offset = side > 0 ? first.corner.size : -first.corner.size;
    const auto centre = meetingBeside(*a, *b, offset, meet);
    if (!centre)
      return false;
    const Vector begin = footOn(*a, *centre), end = footOn(*b, *centre);
    plane.set(first.move.to, begin);
    plane.retrim(first.move, from_);
    give(first.tag, first.move, take);
    give(first.tag, plane.arc(first.move, {begin, end, *centre, true, side < 0}), take);
    plane.retrim(second.move, from_);
    return true;
  }
  if (a->arc || b->arc)
    return false;
  const double legs = first.corner.kind == CornerRequest::Kind::Legs
                          ? first.corner.size
                          : legOfChamfer(first.corner.size, in, out);
  Move chamfer = first.move;
  plane.set(first.move.to, meet - in * legs);
  give(first.tag, first.move, take);
  plane.set(chamfer.to, meet + out * legs);
  give(first.tag, chamfer, take);
  return true;
}

} // namespace ncvet
