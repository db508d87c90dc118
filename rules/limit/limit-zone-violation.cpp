// A move leads into a forbidden zone.
#include "analyzer/rule.h"

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

std::optional<Zone> zoneInForce(llvm::ArrayRef<GroupIndex> groups, const MachineState &state,
                                const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  for (const GroupIndex i : groups) {
    if (!std::has_single_bit(state.group(i)) || state.group(i) == groupUnset)
      continue;
    const CodeInfo &code =
        dialect.codes[dialect.groups[i].members[size_t(std::countr_zero(state.group(i)))]];
    const Origin origin = state.origin.ofGroup(i);
    if (code.action != Action::ZoneOn || !origin.known() || origin.file != ctx.source().id())
      continue;
    // The limits are literal words of the block that switched the zone on.
    const llvm::StringRef text = ctx.source().text();
    const size_t line = text.rfind('\n', origin.begin);
    const uint32_t at =
        line == llvm::StringRef::npos ? ctx.index().reader().first() : uint32_t(line + 1);
    Block block;
    ctx.index().read(at, block);
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
    if (!groups_.empty() && !to.dialect().isLathe())
      to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.number || event.motion == MotionKind::Reference)
      return;
    const MachineState &state = ctx.after();
    const auto zone = zoneInForce(groups_, state, ctx);
    if (!zone || !comparable(*zone, state, ctx))
      return;
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
  /// The work offset in force is the one of the zone's block, and nothing distorts the coordinates.
  static bool comparable(const Zone &zone, const MachineState &state, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const Origin offset = state.originOf(dialect, StandardGroup::WorkOffset);
    if (offset.known() && (offset.file != zone.origin.file || offset.begin > zone.origin.begin))
      return false;
    if (state.origin.of(StatePart::LengthOffset).known() &&
        state.origin.of(StatePart::LengthOffset).begin > zone.origin.begin)
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
