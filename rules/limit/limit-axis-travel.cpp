// A programmed value lies outside of the machine, or of the volume that the program keeps to.
#include "analyzer/rule/rule.h"
#include "formats/dialect/stored_names.h"
#include "interp/geometry/arc.h"
#include "interp/geometry/direction.h"
#include "interp/state/zero_point.h"

#include <cmath>
#include <utility>

namespace ncvet {
namespace {

class LimitAxisTravel final : public Rule {
public:
  void listen(Subscriptions &to) override {
    const MachineProfile &machine = to.machine();
    travels_ = llvm::any_of(machine.axes, [](const AxisLimits &a) { return a.min || a.max; });
    volume_ = llvm::any_of(to.dialect().codes, [](const CodeInfo &code) {
      return llvm::any_of(code.stores, [](const Store &s) { return s.variable == greatest().on; });
    });
    programmed_ = llvm::any_of(to.dialect().codes, [](const CodeInfo &code) {
      return llvm::any_of(code.stores, [](const Store &s) { return s.variable == travelTo()[0]; });
    });
    if (travels_ || volume_ || programmed_)
      to.on(EventKind::Motion);
    to.on({EventKind::SpeedWord, EventKind::FeedWord});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    switch (event.kind) {
    case EventKind::SpeedWord:
      return speed(event, ctx);
    case EventKind::FeedWord:
      return feed(event, ctx);
    default:
      if (travels_)
        travel(event, ctx);
      if (volume_)
        volume(event, ctx);
      if (programmed_)
        ownTravel(event, ctx);
    }
  }

private:
  /// Keys of the variables in which the table's codes leave one corner of the volume (X Y Z, mm in
  /// the work offset), and whether it is guarded.
  struct Corner {
    std::array<uint64_t, 3> axes;
    uint64_t on;
  };
  static const Corner &least() {
    static const Corner keys{{storedKey(StoredName::LeastX), storedKey(StoredName::LeastY),
                              storedKey(StoredName::LeastZ)},
                             storedKey(StoredName::LeastOn)};
    return keys;
  }
  static const Corner &greatest() {
    static const Corner keys{{storedKey(StoredName::GreatestX), storedKey(StoredName::GreatestY),
                              storedKey(StoredName::GreatestZ)},
                             storedKey(StoredName::GreatestOn)};
    return keys;
  }

  /// Keys of the variables in which the table's codes leave the travel to which the program keeps
  /// (X Y Z, mm in machine coordinates).
  static const std::array<uint64_t, 3> &travelFrom() {
    static const std::array<uint64_t, 3> keys{storedKey(StoredName::TravelFromX),
                                              storedKey(StoredName::TravelFromY),
                                              storedKey(StoredName::TravelFromZ)};
    return keys;
  }
  static const std::array<uint64_t, 3> &travelTo() {
    static const std::array<uint64_t, 3> keys{storedKey(StoredName::TravelToX),
                                              storedKey(StoredName::TravelToY),
                                              storedKey(StoredName::TravelToZ)};
    return keys;
  }

  /// Travel that the program has narrowed.
  static void ownTravel(const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    if (event.motion == MotionKind::Reference || ctx.before().profile == ProfileMode::Recorded)
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if ((address.kind != AddressKind::Axis && address.kind != AddressKind::Increment) ||
          unsigned(address.axis) > 2)
        continue;
      const auto axis = unsigned(address.axis);
      const Value from = state.commons.get(travelFrom()[axis]),
                  to = state.commons.get(travelTo()[axis]);
      if (!from.isConstant() && !to.isConstant())
        continue;
      // The length of the tool has a say in where its axis is.
      if (address.axis == toolAxis(ctx.dialect(), state) &&
          !state.inMachineCoordinates(address.axis))
        continue;
      const Interval place = inMachine(address.axis, ctx);
      const bool over = to.isConstant() && place.lo > to.number.value();
      const bool under = from.isConstant() && place.hi < from.number.value();
      if (!over && !under)
        continue;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` leads to {1:f3} in machine coordinates: the program has ended the "
                        "travel at {2:f3}",
                        ctx.text(word), over ? place.lo : place.hi,
                        over ? to.number.value() : from.number.value());
    }
  }

  /// The corner's coordinate when it is known and guarded.
  static std::optional<double> bound(const Corner &corner, unsigned axis,
                                     const MachineState &state) {
    const Value on = state.commons.get(corner.on), place = state.commons.get(corner.axes[axis]);
    if (!on.isConstant() || on.number.value() == 0 || !place.isConstant())
      return std::nullopt;
    return place.number.value();
  }

  static void volume(const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    if (event.motion == MotionKind::Reference || !state.frames.empty() ||
        ctx.before().profile == ProfileMode::Recorded ||
        state.commons.get(greatest().on).kind != Value::Kind::Number)
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if ((address.kind != AddressKind::Axis && address.kind != AddressKind::Increment) ||
          unsigned(address.axis) > 2 || state.inMachineCoordinates(address.axis))
        continue;
      const Interval &place = state.at(address.axis);
      const auto min = bound(least(), unsigned(address.axis), state),
                 max = bound(greatest(), unsigned(address.axis), state);
      const bool over = max && place.lo > *max;
      if (!over && !(min && place.hi < *min))
        continue;
      // Whether the bare code switches on or off is the machine's; this reading is the likely one.
      if (auto finding = ctx.report(word, false))
        finding.severity(Severity::Warning)
            .message("`{0}` leads to {1:f3}, outside of the volume that ends at {2:f3}: the tool "
                     "is lifted there, and goes on at rapid",
                     ctx.text(word), over ? place.lo : place.hi, over ? *max : *min);
      return;
    }
    bulge(event, ctx);
  }

  /// An arc whose ends lie inside of the volume, and whose path does not.
  static void bulge(const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    if (!isArc(event.motion))
      return;
    const ArcGeometry &arc = ctx.arc();
    const std::optional<Point> centre = arc.centre();
    if (!arc.start || !arc.end || !centre || ctx.before().machineAxes || state.machineAxes)
      return;
    const auto axes = ctx.arcWords().axes;
    if (axes[0] != Axis::X || axes[1] != Axis::Y)
      return;
    const double radius = distance(*arc.start, *centre);
    const double turn = event.motion == MotionKind::ArcCcw ? 1 : -1;
    constexpr double whole = 6.283185307179586;
    const double from = angleOf(*arc.start - *centre);
    const auto along = [&](double to) {
      const double way = std::fmod(turn * (to - from) + 2 * whole, whole);
      return way < 1e-9 ? whole : way;
    };
    const double sweep = along(angleOf(*arc.end - *centre));
    for (unsigned quarter = 0; quarter < 4; ++quarter) {
      if (along(quarter * whole / 4) >= sweep)
        continue;
      const auto axis = unsigned(axes[quarter % 2]);
      const double middle = quarter % 2 ? centre->y() : centre->x();
      const double place = middle + (quarter < 2 ? radius : -radius);
      const auto min = axis < 3 ? bound(least(), axis, state) : std::nullopt,
                 max = axis < 3 ? bound(greatest(), axis, state) : std::nullopt;
      constexpr double slack = 1e-6; // mm
      const bool over = max && place > *max + slack;
      if (!over && !(min && place < *min - slack))
        continue;
      if (auto finding = ctx.report(ctx.blockRange(), false))
        finding.severity(Severity::Warning)
            .message("this arc goes as far as {0:f3}, outside of the volume that ends at {1:f3}: "
                     "the tool is lifted there, and goes on at rapid",
                     place, over ? *max : *min);
      return;
    }
  }

  static void speed(const Event &event, RuleContext &ctx) {
    const MachineProfile &machine = ctx.machine();
    // A surface speed is no speed of the spindle; the limit is one.
    if (!event.limitsSpeed() && ctx.dialect().group(StandardGroup::SpeedMode) != noGroup &&
        ctx.after().active(ctx.dialect(), StandardGroup::SpeedMode) != groupUnset &&
        ctx.after().isActive(ctx.dialect(), StandardGroup::SpeedMode, {Action::SurfaceSpeed}) !=
            Truth::No)
      return;
    if (!event.speed().isConstant())
      return;
    const double value = event.speed().value();
    if (machine.spindleMax && value > *machine.spindleMax) {
      if (auto finding = ctx.report(event))
        finding.message("`{0}`: the spindle of this machine turns at {1} 1/min at most",
                        ctx.text(*event.word), *machine.spindleMax);
    } else if (machine.spindleMin && value > 0 && value < *machine.spindleMin &&
               !event.limitsSpeed()) {
      if (auto finding = ctx.report(event))
        finding.message("`{0}`: the spindle of this machine turns at {1} 1/min at least",
                        ctx.text(*event.word), *machine.spindleMin);
    }
  }

  static void feed(const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    if (!ctx.machine().feedMax || !event.feed().isConstant() ||
        state.isActive(ctx.dialect(), StandardGroup::FeedMode, {Action::FeedPerMinute}) !=
            Truth::Yes ||
        state.activeAction(ctx.dialect(), StandardGroup::Units) == Action::Inch)
      return;
    if (event.feed().value() > *ctx.machine().feedMax)
      if (auto finding = ctx.report(event))
        finding.message("`{0}`: the axes of this machine feed at {1} mm/min at most",
                        ctx.text(*event.word), *ctx.machine().feedMax);
  }

  static void travel(const Event &event, RuleContext &ctx) {
    if (event.motion == MotionKind::Reference)
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if (address.kind != AddressKind::Axis && address.kind != AddressKind::Increment)
        continue;
      const AxisLimits &limits = ctx.machine().axes[unsigned(address.axis)];
      if (!limits.min && !limits.max)
        continue;
      const Interval place = inMachine(address.axis, ctx);
      const bool over = limits.max && place.lo > *limits.max;
      const bool under = limits.min && place.hi < *limits.min;
      if (!over && !under)
        continue;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` leads to {1:f3} in machine coordinates: the travel ends at {2:f3}",
                        ctx.text(word), over ? place.lo : place.hi,
                        over ? *limits.max : *limits.min);
    }
  }

  /// Machine coordinate of an axis after the block; unknown where tool data or a transformation
  /// have a say in it.
  static Interval inMachine(Axis axis, const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Dialect &dialect = ctx.dialect();
    const Interval place = state.at(axis);
    if (state.inMachineCoordinates(axis))
      return place;
    if (dialect.zeros.systems) { // the program itself may have moved the zero point
      Place programmed = state.position;
      for (unsigned i = 0; i < axisCount; ++i)
        if (state.inMachineCoordinates(Axis(i)))
          programmed[i] = Interval::unknown();
      return zeroOf(dialect, state).toMachine(programmed)[size_t(axis)];
    }
    if (dialect.isLathe()) // every tool has offsets in both axes
      return Interval::unknown();
    if (dialect.group(StandardGroup::Polar) != noGroup &&
        state.active(dialect, StandardGroup::Polar) != groupUnset &&
        state.isActive(dialect, StandardGroup::Polar, {Action::PolarOn}) != Truth::No)
      return Interval::unknown();
    if (state.origin.of(StatePart::Preset).known() || unsigned(axis) >= 3)
      return Interval::unknown();
    if (axis == toolAxis(dialect, state) &&
        state.active(dialect, StandardGroup::LengthOffset) != groupUnset &&
        state.isActive(dialect, StandardGroup::LengthOffset, {Action::LengthOff}) != Truth::Yes)
      return Interval::unknown();
    const CodeInfo *offset = state.activeCode(dialect, StandardGroup::WorkOffset);
    if (!offset)
      return Interval::unknown();
    const auto origin = ctx.machine().offsets.find(offset->name);
    if (origin == ctx.machine().offsets.end() || !origin->second[unsigned(axis)])
      return Interval::unknown();
    return inOffset(axis, state) + Interval::exactly(*origin->second[unsigned(axis)]);
  }

  /// Coordinate of an axis of space in the work offset, with the frames that lie over it.
  static Interval inOffset(Axis axis, const MachineState &state) {
    if (state.frames.empty())
      return state.at(axis);
    const std::optional<Frame> frame = state.frames.total();
    Point3 place;
    for (unsigned i = 0; i < place.size(); ++i)
      if (!state.inMachineCoordinates(Axis(i)))
        place[i] = state.position[i];
    return frame ? (*frame * place)[size_t(axis)] : Interval::unknown();
  }

  bool travels_ = false;    ///< the machine profile knows the travel of an axis
  bool volume_ = false;     ///< the control guards a volume
  bool programmed_ = false; ///< programs may narrow the travel
};

} // namespace
NCVET_RULE(LimitAxisTravel, limit_axis_travel)
} // namespace ncvet
