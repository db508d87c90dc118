// The motions of cycles that mill an area or a surface, as its envelope: the approach, at each
// depth the path along the outline that the tool's centre may reach, the withdrawal. How an area is
// cleared inside that outline the manuals do not say.
#include "interp/cycles/cycle_moves.h"
#include "interp/cycles/depth_levels.h"
#include "interp/cycles/milling_writer.h"
#include "interp/geometry/direction.h"

namespace ncvet {

namespace {

class AreaMoves : private MillingWriter {
public:
  AreaMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
            llvm::SmallVectorImpl<Move> &moves)
      : MillingWriter(executed, cycle, moves) {}

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
    clockwise_ = clockwise();
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
      return parameters_.length(what, area_).value_or(Interval::unknown());
    };
    const auto count = parameters_.number(Measure::Count);
    const double areas = !count ? 1 : count->isConstant() ? count->value() : 0;
    for (; area_ < std::min(areas, double(mostSteps)); ++area_)
      areaAt({place(Measure::CentreFirst), place(Measure::CentreSecond)}, /*called=*/true);
    if (areas < 1) {
      at_ = executed_.after.position;
      go(MoveKind::Rapid);
    }
    return true;
  }

private:
  /// Levels of a cycle that goes down from where it is: in as many like steps as it repeats.
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

  using MillingWriter::setPlane;
  void setPlane(const Point &place) {
    setPlane(PlanePlace{Interval::exactly(place[0]), Interval::exactly(place[1])});
  }

  /// A cycle that is called goes to its place at the level of the return, one that runs where the
  /// block leads stays at the level on which it is.
  void areaAt(const PlanePlace &centre, bool called) {
    const Place before = at_;
    setPlane(centre);
    if (called)
      go(MoveKind::Rapid, tool_, back_);
    else if (at_ != before || !has(cycle_, CycleTrait::StartsHere))
      go(MoveKind::Rapid);
    // Round an island the tool goes down beside it; the manuals do not say where.
    const PlanePlace unknown, &inside = island_ ? unknown : centre;
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

  /// Down to where the surface begins, along it on a path that is not known, at its end at the
  /// bottom where the table names one. Without words for its begin the tool begins where it is.
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
        setPlane(PlanePlace{first.value_or(at_[size_t(axes_[0])]),
                            second.value_or(at_[size_t(axes_[1])])});
    } else {
      setPlane(PlanePlace{});
    }
    if (at_ != before)
      go(MoveKind::Rapid);
    go(MoveKind::Rapid, tool_, *approach);
    feed(go(MoveKind::Linear, tool_, *top), Measure::FeedDown);
    setPlane(PlanePlace{});
    feed(go(MoveKind::Linear, tool_,
            parameters_.length(Measure::Bottom).value_or(Interval::unknown())),
         Measure::FeedAlong);
    return true;
  }

  std::optional<double> known(Measure what) const {
    const auto value = parameters_.length(what, area_);
    return value && value->isConstant() ? std::optional(std::fabs(value->value())) : std::nullopt;
  }

  /// How far the tool's centre stays from the area's outline.
  std::optional<double> distance() const {
    const auto radius = toolRadius();
    const auto rest = parameters_.length(Measure::SideRest).value_or(Interval::exactly(0));
    if (!radius || !rest.isConstant())
      return std::nullopt;
    return *radius + rest.value();
  }

  /// Once along the outline; where it is not known, one motion to somewhere.
  void outline(const PlanePlace &centre) {
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
    setPlane(PlanePlace{});
    feed(go(MoveKind::Linear), Measure::FeedAlong);
  }

  void lineTo(const Point &place) {
    const Place before = at_;
    setPlane(place);
    if (at_ == before) // round ends meet, or both sides of a long hole are one
      return;
    feed(go(MoveKind::Linear), Measure::FeedAlong);
  }
  void arcTo(const Point &place, const Point &centre, double turns) {
    setPlane(place);
    arc({Interval::exactly(centre[0]), Interval::exactly(centre[1])}, clockwise_, turns);
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
    const auto angle = parameters_.number(Measure::Angle, area_).value_or(Interval::exactly(0));
    if (!angle.isConstant()) {
      setPlane(PlanePlace{});
      feed(go(MoveKind::Linear), Measure::FeedAlong);
      return;
    }
    const double turn = radiansOf(angle.value()), side = clockwise_ ? -1 : 1;
    const auto place = [&](double x, double y) {
      return Point(middle + turnedBy({x, y * side}, turn));
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

  Interval approach_, back_;
  llvm::SmallVector<Interval, 8> levels_;
  bool clockwise_ = false, island_ = false;
  double area_ = 0; ///< which of them, from 0
};

} // namespace

bool appendAreaMoves(const ExecutedBlock &executed, const CodeInfo &cycle,
                     llvm::SmallVectorImpl<Move> &moves) {
  return cycle.cycle >= CycleKind::Face && cycle.cycle != CycleKind::Measure &&
         AreaMoves(executed, cycle, moves).run();
}

} // namespace ncvet
