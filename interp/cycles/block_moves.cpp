// The motions that one executed block makes.
#include "interp/cycles/block_moves.h"

#include "interp/cycles/cycle_moves.h"
#include "interp/cycles/move_feed.h"
#include "interp/evaluate/condition.h"
#include "interp/evaluate/cycle_parameters.h"
#include "interp/evaluate/expression.h"
#include "interp/geometry/contour_element.h"
#include "interp/path/arc_block.h"
#include "interp/state/modes.h"
#include "interp/value/work_meter.h"

namespace ncvet {

namespace {

/// An arc stays one in its plane when the frame does not tilt the plane, and scales its two axes by
/// the same factor.
void resolveArc(const Frame &frame, Move &move) {
  const auto a = size_t(move.plane[0]), b = size_t(move.plane[1]), normal = 3 - a - b;
  Point3 centre;
  centre[a] = move.centre[0];
  centre[b] = move.centre[1];
  centre[normal] = Interval::exactly(0);
  if (!frame.keepsCircles(a, b)) {
    move.centre = {};
    return;
  }
  centre = frame * centre;
  move.centre = {centre[a], centre[b]};
  if (frame.mirrors(a, b))
    move.clockwise = !move.clockwise;
}

/// Turns programmed coordinates into those of the work offset; without a frame they are not known.
void resolveFrames(const std::optional<Frame> &frame, llvm::MutableArrayRef<Move> moves) {
  constexpr unsigned spatial = 3;
  for (Move &move : moves) {
    Point3 place;
    for (unsigned i = 0; i < spatial; ++i)
      if (!(move.machineAxes >> i & 1))
        place[i] = move.to[i];
    place = frame ? *frame * place : Point3();
    for (unsigned i = 0; i < spatial; ++i)
      if (!(move.machineAxes >> i & 1))
        move.to[i] = place[i];
    if (move.kind == MoveKind::Arc) {
      if (frame)
        resolveArc(*frame, move);
      else
        move.centre = {};
    }
  }
}

class BlockMoves {
public:
  BlockMoves(const ExecutedBlock &executed, llvm::SmallVectorImpl<Move> &moves)
      : executed_(executed), dialect_(executed.dialect), moves_(moves) {}

  void run() {
    const size_t first = moves_.size();
    for (const Event &event : executed_.outcome.events)
      take(event);
    if (!executed_.after.frames.empty())
      resolveFrames(executed_.after.frames.total(),
                    llvm::MutableArrayRef(moves_).drop_front(first));
  }

private:
  Move &add(MoveKind kind) {
    Move &move = moves_.emplace_back();
    move.kind = kind;
    move.to = executed_.after.position;
    move.machineAxes = executed_.after.machineAxes;
    if (kind == MoveKind::Linear || kind == MoveKind::Arc || kind == MoveKind::Thread)
      setFeed(dialect_, executed_.after, move);
    return move;
  }

  void take(const Event &event) {
    switch (event.kind) {
    case EventKind::ToolChange:
      add(MoveKind::Tool).value =
          event.tool() >= 0 ? Interval::exactly(double(event.tool())) : Interval::unknown();
      return;
    case EventKind::SpindleChange: {
      Move &move = add(MoveKind::Spindle);
      move.spindle = executed_.after.spindle;
      move.value = executed_.after.speed;
      return;
    }
    case EventKind::Dwell:
      add(MoveKind::Dwell).value = event.seconds();
      return;
    case EventKind::Motion:
      return motion(event);
    case EventKind::CycleRun:
      return appendCycleMoves(executed_, event, moves_);
    case EventKind::ProgramEnd:
      add(MoveKind::End);
      return;
    default:
      return;
    }
  }

  void motion(const Event &event) {
    switch (event.motion) {
    case MotionKind::Rapid:
      add(MoveKind::Rapid);
      return;
    case MotionKind::Reference:
      viaPoint(event);
      add(MoveKind::Rapid);
      return;
    case MotionKind::ArcCw:
    case MotionKind::ArcCcw:
      return arc(event.motion == MotionKind::ArcCw);
    case MotionKind::Thread:
      return thread(event);
    case MotionKind::Feed:
    case MotionKind::Skip:
      return feed(event);
    }
  }

  void thread(const Event &event) {
    if (event.code != noCode && dialect_.codes[event.code].returns)
      add(MoveKind::Thread).to = executed_.outcome.via;
    add(MoveKind::Thread);
  }

  void feed(const Event &event) {
    const Action action = event.code == noCode ? Action::Linear : dialect_.codes[event.code].action;
    if (action == Action::CurvePoint)
      return;
    if (action == Action::CurveTangent) {
      Move &move = add(MoveKind::Arc);
      move.tangential = true;
      move.plane = planeOrder(dialect_, executed_.after);
    } else if (action == Action::CurveThrough) {
      arcThrough();
    } else if (action == Action::CurveFeed && arcAboutCentre(dialect_.codes[event.code])) {
      return;
    } else {
      add(MoveKind::Linear);
    }
  }

  /// The path to the reference point leads through the point that the block names.
  void viaPoint(const Event &event) {
    if (!event.axes || event.code == noCode ||
        dialect_.codes[event.code].action != Action::ReferenceReturn)
      return;
    Move &via = add(MoveKind::Rapid);
    via.to = executed_.outcome.via;
    via.machineAxes = executed_.before.machineAxes & ~uint32_t(event.axes);
  }

  std::optional<double> length(const Word &word) const {
    const Interval v =
        lengthOf(word, executed_.block, dialect_, executed_.machine, executed_.after);
    return v.isConstant() ? std::optional(v.value()) : std::nullopt;
  }

  void arc(bool clockwise) {
    Move &move = add(MoveKind::Arc);
    move.clockwise = clockwise;
    const ArcWords words = arcWords(dialect_, executed_.after, executed_.block);
    ArcGeometry arc = arcGeometry(words, dialect_, executed_.machine, executed_.block,
                                  executed_.before, executed_.after);
    move.plane = words.axes;
    std::optional<Point> centre = arc.centre();
    if (!words.hasCentre() && words.radius)
      move.radius = arc.radius;
    if (!words.hasCentre() && arc.start && arc.end) {
      if (words.radius && arc.radius)
        centre = centreByRadius(*arc.start, *arc.end, *arc.radius, clockwise);
      else if (const auto degrees = angleOf(words))
        centre = centreByAngle(*arc.start, *arc.end, *degrees, clockwise);
      else if (const auto &pole = executed_.before.pole; // angle and radius turn about the pole
               executed_.block.hasAny(dialect_.polarWords) && pole[0].isConstant() &&
               pole[1].isConstant())
        centre = Point(pole[0].value(), pole[1].value());
    }
    if (!centre)
      return;
    if (const auto degrees = angleOf(words); degrees && words.hasCentre() && arc.start) {
      arc.end = turnedAbout(*centre, *arc.start, radiansOf(*degrees * (clockwise ? -1 : 1)));
      for (size_t i = 0; i < 2; ++i)
        move.to[size_t(words.axes[i])] =
            Interval::exactly((*arc.end)[i] * dialect_.lengthsPerUnit(words.axes[i]));
    }
    setCentre(move, *centre);
    if (arc.start && arc.end)
      move.turns =
          Interval::exactly(turnsAround(*centre, *arc.start, *arc.end, clockwise) + furtherTurns());
  }
  void setCentre(Move &move, const Point &centre) const {
    for (size_t i = 0; i < 2; ++i)
      move.centre[i] = Interval::exactly(centre[i] * dialect_.lengthsPerUnit(move.plane[i]));
  }
  std::optional<double> angleOf(const ArcWords &words) const {
    if (!words.angle)
      return std::nullopt;
    const Interval v = assignedWordValue(*words.angle, executed_.block, executed_.after);
    return v.isConstant() ? std::optional(v.value()) : std::nullopt;
  }
  /// Full turns beside the one that leads to the end.
  double furtherTurns() const {
    const CodeInfo *code = executed_.after.activeCode(dialect_, StandardGroup::Motion);
    if (code)
      for (const WordSpec &spec : code->words)
        if (const Word *word = wordFor(executed_.block, spec)) {
          const Interval v = assignedWordValue(*word, executed_.block, executed_.after);
          if (v.isConstant() && spec.role == Role::Repeat)
            return v.value();
          if (v.isConstant() && spec.role == Role::PassCount) // all of them are counted
            return std::max(0.0, v.value() - 1);
        }
    return 0;
  }

  /// About the centre that the table's measures give; false when it gives none.
  bool arcAboutCentre(const CodeInfo &code) {
    const CycleParameters parameters(executed_, code);
    const auto first = parameters.length(Measure::CentreFirst),
               second = parameters.length(Measure::CentreSecond);
    if (!first || !second)
      return false;
    Move &move = add(MoveKind::Arc);
    move.plane = planeOrder(dialect_, executed_.after);
    move.centre = {*first, *second};
    move.clockwise = parameters.number(Measure::Direction) == Interval::exactly(clockwiseDirection);
    const ContourPlane plane(dialect_, move.plane);
    const auto start = plane.point(executed_.before.position), end = plane.point(move.to);
    if (start && end && first->isConstant() && second->isConstant())
      move.turns = Interval::exactly(
          turnsAround({first->value(), second->value()}, *start, *end, move.clockwise));
    return true;
  }

  /// Through a third point, in the plane of the tool's two axes.
  void arcThrough() {
    Move &move = add(MoveKind::Arc);
    move.plane = planeOrder(dialect_, executed_.after);
    const ArcWords words = arcWords(dialect_, executed_.after, executed_.block);
    const ArcGeometry arc = arcGeometry(words, dialect_, executed_.machine, executed_.block,
                                        executed_.before, executed_.after);
    if (!arc.start || !arc.end)
      return;
    const bool incremental = executed_.after.isActive(dialect_, StandardGroup::Distance,
                                                      {Action::Incremental}) == Truth::Yes;
    Point through = *arc.start;
    for (size_t i = 0; i < 2; ++i)
      if (const Word *word = executed_.block.find(dialect_.arcThrough[size_t(move.plane[i])])) {
        const auto v = length(*word);
        if (!v)
          return;
        const WordReading reading = word->reading();
        const bool added =
            reading == WordReading::Incremental || (reading == WordReading::Modal && incremental);
        const Interval share = shareOfDiameter(dialect_, executed_.after, move.plane[i],
                                               added ? Truth::Yes : Truth::No);
        if (!share.isConstant())
          return;
        through[i] = *v * share.value() / dialect_.lengthsPerUnit(move.plane[i]) +
                     (added ? (*arc.start)[i] : 0);
      }
    const auto centre = centreOfThree(*arc.start, through, *arc.end);
    if (!centre)
      return;
    move.clockwise = cross(through - *arc.start, *arc.end - through) < 0;
    setCentre(move, *centre);
    move.turns = Interval::exactly(turnsAround(*centre, *arc.start, *arc.end, move.clockwise) +
                                   furtherTurns());
  }

  const ExecutedBlock &executed_;
  const Dialect &dialect_;
  llvm::SmallVectorImpl<Move> &moves_;
};

} // namespace

void appendReturn(const ExecutedBlock &executed, llvm::SmallVectorImpl<Move> &moves) {
  Move &move = moves.emplace_back();
  move.to = executed.before.position;
  move.machineAxes = executed.before.machineAxes;
  if (!executed.before.frames.empty())
    resolveFrames(executed.before.frames.total(), move);
}

void appendMoves(const ExecutedBlock &executed, llvm::SmallVectorImpl<Move> &moves) {
  const size_t before = moves.size();
  BlockMoves(executed, moves).run();
  workDone += moves.size() - before;
}

} // namespace ncvet
