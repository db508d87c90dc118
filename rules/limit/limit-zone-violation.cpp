// A move leads into a forbidden zone.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <array>
#include <bit>
#include <optional>
#include <utility>

namespace ncvet {
namespace {

/// The box of the zone that is certainly in force, in the coordinates of its own block; false when
/// it is not known.
struct Zone {
  std::array<std::optional<double>, 3> min, max;
  bool outsideForbidden = false;
  Origin origin;
};

/// No reference says whether the limits of X are diameters, as its coordinates are, or radii: only
/// what breaks both of them counts.
void allowForRadius(Zone &zone) {
  constexpr unsigned x = unsigned(Axis::X);
  std::optional<double> &min = zone.min[x], &max = zone.max[x];
  if (min)
    min = zone.outsideForbidden ? std::min(*min, 2 * *min) : std::max(*min, 2 * *min);
  if (max)
    max = zone.outsideForbidden ? std::max(*max, 2 * *max) : std::min(*max, 2 * *max);
}

std::optional<Zone> zoneInForce(llvm::ArrayRef<GroupIndex> groups, const MachineState &state,
                                const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  for (const GroupIndex i : groups) {
    if (!std::has_single_bit(state.group(i)) || state.group(i) == groupUnset)
      continue;
    const CodeInfo &code =
        dialect.codes[dialect.groups[i].members[size_t(std::countr_zero(state.group(i)))]];
    if (code.action != Action::ZoneOn)
      continue;
    const Origin origin = state.origin.ofGroup(i);
    if (!origin.known())
      continue;
    // The limits are literal words of the block that switched the zone on.
    Block block;
    readBlockOf(ctx, origin, block);
    Zone zone;
    zone.origin = origin;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (const Word *word = block.find("XYZ"[axis]); word && word->isNumber())
        zone.max[axis] = word->value();
      if (const Word *word = block.find("IJK"[axis]); word && word->isNumber())
        zone.min[axis] = word->value();
    }
    const Word *p = block.find('P');
    if (!p || !p->isNumber())
      return std::nullopt;
    zone.outsideForbidden = p->value() == 1;
    for (unsigned axis = 0; axis < 3; ++axis)
      if (zone.min[axis] && zone.max[axis] && *zone.min[axis] > *zone.max[axis])
        return std::nullopt; // another rule speaks of limits that are no zone
    if (dialect.lengthsPerUnit(Axis::X) != 1)
      allowForRadius(zone);
    return zone;
  }
  return std::nullopt;
}

class LimitZoneViolation final : public Rule {
public:
  void listen(Subscriptions &to) override {
    for (const CodeInfo &code : to.dialect().codes)
      if (code.action == Action::ZoneOn && code.group != noGroup &&
          !llvm::is_contained(groups_, code.group))
        groups_.push_back(code.group);
    if (!groups_.empty())
      to.on(EventKind::Motion);
    if (!groups_.empty() && !to.dialect().isLathe())
      to.on(EventKind::CycleRun);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.inMachineCoordinates() || event.motion == MotionKind::Reference)
      return;
    const MachineState &state = ctx.after();
    const auto zone = zoneInForce(groups_, state, ctx);
    if (!zone)
      return sleepInShape();
    if (!comparable(*zone, state, ctx))
      return sleepInStretch();
    if (event.kind == EventKind::CycleRun)
      return holes(event, *zone, ctx);
    bool inside = true;
    const Word *culprit = nullptr;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Interval &place = state.position[axis];
      const bool limited = zone->min[axis] || zone->max[axis];
      if (!limited)
        continue;
      const bool over = zone->max[axis] && place.lo > *zone->max[axis];
      const bool under = zone->min[axis] && place.hi < *zone->min[axis];
      if ((over || under) && !culprit)
        for (const Word &word : ctx.block().words)
          if ((ctx.dialect().axisWords & maskOf(word.address)) &&
              unsigned(ctx.dialect().addresses[word.address].axis) == axis)
            culprit = &word;
      // Certainly strictly inside this pair of limits.
      inside &= zone->min[axis] && zone->max[axis] && place.lo > *zone->min[axis] &&
                place.hi < *zone->max[axis];
    }
    if (!zone->outsideForbidden && !inside && leadsThrough(event, *zone, ctx)) {
      if (auto finding = ctx.report(event))
        finding.message("this move leads through the forbidden zone")
            .note(zone->origin, "the zone is switched on here");
      return;
    }
    if (zone->outsideForbidden ? !culprit : !inside)
      return;
    auto finding = zone->outsideForbidden ? ctx.report(*culprit) : ctx.report(event);
    if (finding)
      finding
          .message(zone->outsideForbidden
                       ? "this position lies outside of the zone that may not be left"
                       : "this position lies inside of the forbidden zone")
          .note(zone->origin, "the zone is switched on here");
  }

private:
  /// Whether a straight path between two known places crosses the box. At rapid only a move of one
  /// axis is sure to be straight.
  static bool leadsThrough(const Event &event, const Zone &zone, const RuleContext &ctx) {
    const bool straight =
        event.motion == MotionKind::Feed || event.motion == MotionKind::Thread ||
        (event.motion == MotionKind::Rapid && std::has_single_bit(unsigned(event.axes)));
    std::array<double, 3> from{}, to{};
    for (unsigned axis = 0; axis < 3; ++axis) {
      const Interval &begin = ctx.before().position[axis], &end = ctx.after().position[axis];
      if (!begin.isConstant() || !end.isConstant() || ctx.before().inMachineCoordinates(Axis(axis)))
        return false;
      from[axis] = begin.value();
      to[axis] = end.value();
    }
    return straight && event.certain && crosses(zone, from, to);
  }

  static bool crosses(const Zone &zone, const std::array<double, 3> &from,
                      const std::array<double, 3> &to) {
    double enters = 0, leaves = 1; // shares of the path
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (!zone.min[axis] || !zone.max[axis])
        return false;
      const double way = to[axis] - from[axis];
      double a = *zone.min[axis] - from[axis], b = *zone.max[axis] - from[axis];
      if (way == 0) {
        if (a >= 0 || b <= 0)
          return false;
        continue;
      }
      if (way < 0)
        std::swap(a, b);
      enters = std::max(enters, a / way);
      leaves = std::min(leaves, b / way);
    }
    constexpr double touches = 1e-6;
    return enters + touches < leaves;
  }

  /// Whether the words that the cycle keeps are coordinates and no increments.
  static bool isAbsolute(const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Origin &cycle = state.origin.of(StatePart::Cycle);
    const Origin distance = state.originOf(ctx.dialect(), StandardGroup::Distance);
    if (state.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
            Truth::No ||
        !cycle.known() ||
        (distance.known() && distance.file == cycle.file && distance.begin > cycle.end))
      return false;
    Block first;
    readBlockOf(ctx, cycle, first);
    const auto increment = [](const Word &word) { return word.has(wordIncremental); };
    return llvm::none_of(first.words, increment) && llvm::none_of(ctx.block().words, increment);
  }

  /// The holes of a cycle, from the level of its approach to the bottom.
  static void holes(const Event &event, const Zone &zone, RuleContext &ctx) {
    if (event.code == noCode || !event.certain || !makesHole(ctx.code(event).cycle))
      return;
    const CodeInfo &code = ctx.code(event);
    const MachineState &state = ctx.after();
    const Dialect &dialect = ctx.dialect();
    const auto unit = millimetresPer(dialect, state);
    const auto r = kept(state, code, Role::Retract), z = kept(state, code, Role::Depth);
    if (!unit || !r || !z || !isAbsolute(ctx) || toolAxis(dialect, state) != Axis::Z ||
        code.cycle == CycleKind::BackBore)
      return;
    const double top = *r * *unit, bottom = *z * *unit;
    for (const auto &hole : ctx.outcome().holes) {
      std::array<double, 3> from{0, 0, top}, to{0, 0, bottom};
      bool known = true, outside = bottom < zone.min[2].value_or(bottom);
      for (unsigned axis = 0; axis < 2; ++axis) {
        known &= hole[axis].isConstant();
        if (!known)
          break;
        from[axis] = to[axis] = hole[axis].value();
        outside |= to[axis] < zone.min[axis].value_or(to[axis]) ||
                   to[axis] > zone.max[axis].value_or(to[axis]);
      }
      if (!known || (zone.outsideForbidden ? !outside : !crosses(zone, from, to)))
        continue;
      if (auto finding = ctx.report(ctx.blockRange()))
        finding
            .message(zone.outsideForbidden ? "`{0}` leaves the zone that may not be left"
                                           : "`{0}` works in the forbidden zone",
                     code.name)
            .note(zone.origin, "the zone is switched on here");
      return;
    }
  }

  /// The work offset in force is the one of the zone's block, and nothing distorts the coordinates.
  static bool comparable(const Zone &zone, const MachineState &state, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const Origin offset = state.originOf(dialect, StandardGroup::WorkOffset);
    if (offset.known() && (offset.file != zone.origin.file || offset.begin > zone.origin.begin))
      return false;
    if (state.origin.of(StatePart::LengthOffset).known() &&
        state.origin.of(StatePart::LengthOffset).begin > zone.origin.begin)
      return false;
    // On a lathe the T word brings the lengths.
    const Origin &tool = state.origin.of(StatePart::Tool);
    if (dialect.isLathe() && tool.known() &&
        (tool.file != zone.origin.file || tool.begin > zone.origin.begin))
      return false;
    if (dialect.group(StandardGroup::Polar) != noGroup &&
        state.active(dialect, StandardGroup::Polar) != groupUnset &&
        state.isActive(dialect, StandardGroup::Polar, {Action::PolarOn}) != Truth::No)
      return false;
    return state.frames.empty() && !state.origin.of(StatePart::Preset).known();
  }

  llvm::SmallVector<GroupIndex, 2> groups_; ///< those that hold a code which switches a zone on
};

} // namespace
NCVET_RULE(LimitZoneViolation, limit_zone_violation)
} // namespace ncvet
