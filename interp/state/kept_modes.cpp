// Modes that a program keeps, to bring them back later: M70 to M73 of LinuxCNC.
#include "interp/state/kept_modes.h"

#include "interp/state/zero_point.h"

namespace ncvet {

namespace {

constexpr uint64_t technologyFacts = bitOf(Fact::FeedSet) | bitOf(Fact::SpeedSet);

bool mayBePreset(const Dialect &dialect, const MachineState &state) {
  const auto on = uint64_t(dialect.zeros.presetOn);
  return dialect.zeros.systems && !(state.commons.get(on) == Value::of(0));
}

/// Any modes may be in force, but for the motion and the cycle.
void bringBackAny(const Dialect &dialect, MachineState &state) {
  const MachineState any = unknownState(dialect);
  const auto before = state.groups;
  state.groups = any.groups;
  for (const StandardGroup which : {StandardGroup::Motion, StandardGroup::Cycle})
    if (const GroupIndex kept = dialect.group(which); kept != noGroup)
      state.groups[kept] = before[kept];
  state.feed = Interval::unknown();
  state.speed = Interval::unknown();
  state.compensation = any.compensation;
  state.spindle = spindleAny;
  state.switches.may = any.switches.may;
  state.switches.must = 0;
  state.factsMay |= technologyFacts;
  state.factsMust &= ~technologyFacts;
  state.position = any.position;
}

Interval shifted(const Interval &place, const Interval &before, const Interval &now) {
  if (place.isUnknown() || before.isUnknown() || now.isUnknown())
    return Interval::unknown();
  return place + before - now;
}

/// What comes back of the zero point: the work offset, no length where none was in force, and no
/// shift where none was (rs274 of LinuxCNC 2.9). Other lengths and shifts are not known.
void bringBackZero(const Dialect &dialect, MachineState &state, const MachineState &was,
                   bool presetOn) {
  const Zero before = zeroOf(dialect, state);
  const GroupIndex lengths = dialect.group(StandardGroup::LengthOffset);
  if (lengths != noGroup && state.group(lengths) != was.group(lengths)) {
    Place length;
    if (state.activeAction(dialect, StandardGroup::LengthOffset) == Action::LengthOff)
      length.fill(Interval::exactly(0));
    storePlace(state, dialect.zeros.length, length);
  }
  if (presetOn != mayBePreset(dialect, state))
    state.commons.set(uint64_t(dialect.zeros.presetOn), presetOn ? Value::unknown() : Value::of(0));
  const auto system = activeSystem(dialect, state);
  const bool moved = state.active(dialect, StandardGroup::WorkOffset) !=
                     was.active(dialect, StandardGroup::WorkOffset);
  if (moved && system)
    selectSystem(dialect, state, *system);
  Zero now = zeroOf(dialect, state);
  Place place = state.position;
  for (size_t i = 0; i < axisCount; ++i) {
    if (!(before.length[i] == now.length[i]))
      place[i] = shifted(place[i], before.length[i], now.length[i]);
    if (!(before.preset[i] == now.preset[i]))
      place[i] = shifted(place[i], before.preset[i], now.preset[i]);
  }
  if (moved) {
    Zero from = before;
    for (Zero *zero : {&from, &now}) {
      zero->preset.fill(Interval::exactly(0));
      zero->length.fill(Interval::exactly(0));
    }
    place = system ? now.toProgrammed(from.toMachine(place)) : Place{};
  }
  for (size_t i = 0; i < axisCount; ++i)
    if (!(state.machineAxes >> i & 1))
      state.position[i] = place[i];
}

} // namespace

SavedModes keepModes(const Dialect &dialect, const MachineState &state) {
  stateUse.everything();
  KeptModes kept;
  kept.modes = state;
  kept.feed = state.feed;
  kept.speed = state.speed;
  kept.factsMay = state.factsMay & technologyFacts;
  kept.factsMust = state.factsMust & technologyFacts;
  kept.switches = state.switches;
  kept.spindle = state.spindle;
  kept.presetOn = mayBePreset(dialect, state);
  return {std::make_shared<const KeptModes>(kept), true};
}

void bringBack(const Dialect &dialect, MachineState &state, const SavedModes &saved) {
  stateUse.everything();
  const KeptModes *kept = saved.modes.get();
  if (!saved.known)
    return bringBackAny(dialect, state);
  if (!kept) // an alarm
    return;
  const MachineState was = state;
  state.groups = kept->modes.groups;
  if (state.active(dialect, StandardGroup::Compensation) !=
      was.active(dialect, StandardGroup::Compensation)) {
    // With which radius it comes back on is not followed.
    if (state.compensationActive(dialect) != Truth::No)
      return bringBackAny(dialect, state);
    state.compensation = state.compensation & phaseOn ? phaseEnding : phaseOff;
  }
  for (const StandardGroup which : {StandardGroup::Motion, StandardGroup::Cycle})
    if (const GroupIndex stays = dialect.group(which); stays != noGroup)
      state.groups[stays] = was.groups[stays];
  state.feed = kept->feed;
  state.speed = kept->speed;
  state.factsMay = (state.factsMay & ~technologyFacts) | kept->factsMay;
  state.factsMust = (state.factsMust & ~technologyFacts) | kept->factsMust;
  state.switches = kept->switches;
  state.spindle = kept->spindle;
  if (dialect.zeros.systems)
    bringBackZero(dialect, state, was, kept->presetOn);
}

} // namespace ncvet
