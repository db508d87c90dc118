// The motions of cycles that mill an area or a surface, as its envelope: the approach, at each
// depth the way along the outline that the tool's centre may reach, the withdrawal. How an area is
// cleared inside that outline the manuals do not say.
#include "interp/cycle_moves.h"
#include "interp/cycle_writer.h"
#include "interp/depth_levels.h"
#include "interp/tool_data.h"

#include <cmath>
#include <numbers>

namespace ncvet {

namespace {

using Point = std::array<double, 2>;

class AreaMoves : private CycleWriter {
public:
  AreaMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
            llvm::SmallVectorImpl<Move> &moves)
      : CycleWriter(executed, cycle, moves), parameters_(executed, cycle),
        tool_(toolAxis(executed.dialect, executed.after)),
        axes_(planeOrder(executed.dialect, executed.after)) {}

  /// False when the table says nothing of the cycle's levels.
  bool run() {
    if (cycle_.cycle == CycleKind::Surface)
      return surface();
    const bool here = has(cycle_, CycleTrait::StartsHere);
    const auto approach = here ? at_[size_t(tool_)] : approachLevel(parameters_);
    levels_ = here ? levelsFromHere() : depthLevels(parameters_);
    if (!approach || levels_.empty())
      return false;
    approach_ = *approach;
    back_ = here ? executed_.after.at(tool_) : backLevel(parameters_).value_or(Interval::unknown());
    island_ = parameters_.number(Measure::Island) == Interval::exactly(1);
    clockwise_ = parameters_.number(Measure::Direction) == Interval::exactly(clockwiseDirection);
    if (here) {
      areaAt({executed_.after.at(axes_[0]), executed_.after.at(axes_[1])}, /*called=*/false);
      return true;
    }
    if (!executed_.outcome.holes.empty()) {
      for (const Place &place : executed_.outcome.holes)
        areaAt({place[size_t(axes_[0])], place[size_t(axes_[1])]}, /*called=*/false);
      return true;
    }
    const auto place = [&](Measure what) {
      return parameters_.length(what).value_or(Interval::unknown());
    };
    const auto count = parameters_.number(Measure::Count);
    const double areas = !count ? 1 : count->isConstant() ? count->value() : 0;
    for (double area = 0; area < std::min(areas, double(mostSteps)); ++area)
      areaAt({place(Measure::CentreFirst), place(Measure::CentreSecond)}, /*called=*/true);
    if (areas < 1) {
      at_ = executed_.after.position;
      go(MoveKind::Rapid);
    }
    return true;
  }

private:
  /// Levels of a cycle that goes down from where it stands: in as many like steps as it repeats.
  llvm::SmallVector<Interval, 8> levelsFromHere() const {
    llvm::SmallVector<Interval, 8> list;
    const Interval &from = at_[size_t(tool_)], &to = executed_.after.at(tool_);
    const auto repeat = words_.value(Role::Repeat).value_or(Interval::exactly(1));
    const bool steps = executed_.after.isActive(executed_.dialect, StandardGroup::Distance,
                                                {Action::Incremental}) == Truth::Yes &&
                       from.isConstant() && to.isConstant() && repeat.isConstant();
    const double count = steps ? std::min(repeat.value(), double(mostSteps)) : 1;
    for (double n = 1; n < count; ++n)
      list.push_back(Interval::exactly(from.value() + n / count * (to.value() - from.value())));
    list.push_back(to);
    return list;
  }

  void setPlane(const std::array<Interval, 2> &place) {
    for (size_t i = 0; i < 2; ++i) {
      at_[size_t(axes_[i])] = place[i];
      machineAxes_ &= ~(1u << unsigned(axes_[i]));
    }
  }
  void setPlane(const Point &place) {
    setPlane({Interval::exactly(place[0]), Interval::exactly(place[1])});
  }

  /// A cycle that is called goes to its place at the level of the return, one that runs where the
  /// block leads stays at the level on which it is.
  void areaAt(const std::array<Interval, 2> &centre, bool called) {
    const Place before = at_;
    setPlane(centre);
    if (called)
      go(MoveKind::Rapid, tool_, back_);
    else if (at_ != before || !has(cycle_, CycleTrait::StartsHere))
      go(MoveKind::Rapid);
    // Round an island the tool goes down beside it; the manuals do not say where.
    const std::array<Interval, 2> unknown, &inside = island_ ? unknown : centre;
    if (island_) {
      setPlane(unknown);
      go(MoveKind::Rapid);
    }
    if (!has(cycle_, CycleTrait::StartsHere))
      go(MoveKind::Rapid, tool_, approach_);
    for (const Interval &level : levels_) {
      feed(go(MoveKind::Linear, tool_, level), Measure::FeedDown);
      outline(centre);
      setPlane(inside);
      if (inside[0].isConstant() && inside[1].isConstant())
        feed(go(MoveKind::Linear), Measure::FeedAlong);
    }
    if (!has(cycle_, CycleTrait::StartsHere))
      go(MoveKind::Rapid, tool_, back_);
    if (island_ && !called) {
      setPlane(centre);
      go(MoveKind::Rapid);
    }
  }

  /// Down to where the surface begins, along it on a way that is not known, at its end at the
  /// bottom where the table names one. Without words for its begin the tool begins where it stands.
  bool surface() {
    const auto approach = approachLevel(parameters_);
    const auto top = parameters_.length(Measure::Top);
    if (!approach || !top)
      return false;
    const Place before = at_;
    if (parameters_.has(Measure::CentreFirst)) {
      const auto first = parameters_.length(Measure::CentreFirst),
                 second = parameters_.length(Measure::CentreSecond);
      if (first || second)
        setPlane({first.value_or(at_[size_t(axes_[0])]), second.value_or(at_[size_t(axes_[1])])});
    } else {
      setPlane({Interval::unknown(), Interval::unknown()});
    }
    if (at_ != before)
      go(MoveKind::Rapid);
    go(MoveKind::Rapid, tool_, *approach);
    feed(go(MoveKind::Linear, tool_, *top), Measure::FeedDown);
    setPlane({Interval::unknown(), Interval::unknown()});
    feed(go(MoveKind::Linear, tool_,
            parameters_.length(Measure::Bottom).value_or(Interval::unknown())),
         Measure::FeedAlong);
    return true;
  }

  void feed(Move &move, Measure what) const {
    if (const auto own = parameters_.length(what)) {
      move.feed = *own;
      if (move.feedMode == Action::None)
        move.feedMode = Action::FeedPerMinute;
    }
  }

  std::optional<double> known(Measure what) const {
    const auto value = parameters_.length(what);
    return value && value->isConstant() ? std::optional(std::fabs(value->value())) : std::nullopt;
  }

  /// How far the tool's centre stays from the area's outline.
  std::optional<double> distance() const {
    const ToolData *tool = toolInUse(executed_.machine, executed_.before);
    if (!tool || !tool->radius)
      tool = compensatingTool(executed_.dialect, executed_.machine, executed_.before);
    const auto rest = parameters_.length(Measure::SideRest).value_or(Interval::exactly(0));
    if (!tool || !tool->radius || !rest.isConstant())
      return std::nullopt;
    return *tool->radius + rest.value();
  }

  /// Once along the outline; where it is not known, one motion to somewhere.
  void outline(const std::array<Interval, 2> &centre) {
    const auto off = distance();
    if (centre[0].isConstant() && centre[1].isConstant() && off) {
      const double by = island_ ? *off : -*off;
      const Point middle{centre[0].value(), centre[1].value()};
      const auto radius = known(Measure::Radius);
      if (radius && *radius + by > tolerance)
        return circle(middle, *radius + by);
      const auto length = known(Measure::Length), width = known(Measure::Width);
      if (length && width && *length / 2 + by >= 0 && *width / 2 + by >= 0)
        return rectangle(middle, *length / 2 + by, *width / 2 + by, by);
    }
    setPlane({Interval::unknown(), Interval::unknown()});
    feed(go(MoveKind::Linear), Measure::FeedAlong);
  }

  void lineTo(const Point &place) {
    setPlane(place);
    feed(go(MoveKind::Linear), Measure::FeedAlong);
  }
  void arcTo(const Point &place, const Point &centre, double turns) {
    setPlane(place);
    Move &move = go(MoveKind::Arc);
    setFeed(executed_.dialect, executed_.after, move);
    feed(move, Measure::FeedAlong);
    move.plane = axes_;
    move.centre = {Interval::exactly(centre[0]), Interval::exactly(centre[1])};
    move.clockwise = clockwise_;
    move.turns = Interval::exactly(turns);
  }

  void circle(const Point &middle, double radius) {
    const Point start{middle[0] + radius, middle[1]};
    lineTo(start);
    arcTo(start, middle, 1);
  }

  /// Half its sides; `by` is how far it lies outside of what is programmed.
  void rectangle(const Point &middle, double a, double b, double by) {
    const double corner = std::max(0.0, known(Measure::Rounding).value_or(0) + by);
    const double r = std::min({corner, a, b});
    const auto angle = parameters_.number(Measure::Angle).value_or(Interval::exactly(0));
    if (!angle.isConstant()) {
      setPlane({Interval::unknown(), Interval::unknown()});
      feed(go(MoveKind::Linear), Measure::FeedAlong);
      return;
    }
    const double turn = angle.value() * std::numbers::pi / 180, side = clockwise_ ? -1 : 1;
    const auto place = [&](double x, double y) {
      return Point{middle[0] + x * std::cos(turn) - y * side * std::sin(turn),
                   middle[1] + x * std::sin(turn) + y * side * std::cos(turn)};
    };
    // From the middle of a side: the four corners, each by the end of its side, its centre, its
    // end. Clockwise it is the mirror image.
    const double x[] = {a, -a, -a, a}, y[] = {b, b, -b, -b};
    lineTo(place(a, 0));
    for (size_t i = 0; i < 4; ++i) {
      const double sx = x[i] > 0 ? 1 : -1, sy = y[i] > 0 ? 1 : -1;
      const bool upright = i % 2 == 0; // the side that leads to the corner
      lineTo(upright ? place(x[i], y[i] - sy * r) : place(x[i] - sx * r, y[i]));
      if (r > tolerance)
        arcTo(upright ? place(x[i] - sx * r, y[i]) : place(x[i], y[i] - sy * r),
              place(x[i] - sx * r, y[i] - sy * r), 0.25);
    }
    lineTo(place(a, 0));
  }

  const CycleParameters parameters_;
  const Axis tool_;
  const std::array<Axis, 2> axes_;
  Interval approach_, back_;
  llvm::SmallVector<Interval, 8> levels_;
  bool clockwise_ = false, island_ = false;
};

} // namespace

bool appendAreaMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                     llvm::SmallVectorImpl<Move> &moves) {
  return cycle.cycle >= CycleKind::Face && cycle.cycle != CycleKind::Measure &&
         AreaMoves(executed, cycle, moves).run();
}

} // namespace ncvet
