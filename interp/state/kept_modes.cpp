// Modes that a program keeps, to bring them back later: M70 to M73 of LinuxCNC.
#include "interp/state/kept_modes.h"

#include "interp/state/zero_point.h"

namespace ncvet {

namespace {

constexpr uint64_t technologyFacts = bitOf(Fact::FeedSet) | bitOf(Fact::SpeedSet);

/// Whether a shift over all work offsets is in force: 1, 0 or not known.
Interval presetOn(const Dialect &dialect, const MachineState &state) {
  return dialect.zeros.systems ? state.commons.get(uint64_t(dialect.zeros.presetOn)).asNumber()
                               : Interval::exactly(0);
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

/// Whether a length offset other than zero is in force.
Truth lengthOn(const Dialect &dialect, const MachineState &state) {
  Truth any = Truth::No;
  for (const Interval &length : zeroOf(dialect, state).length)
    if (length.isConstant() && length.value() != 0)
      return Truth::Yes;
    else if (!length.isConstant())
      any = Truth::Unknown;
  return any;
}

/// Where the one is in force and the other is not, it is switched: off, or on with the length of
/// the tool in the spindle (rs274 of LinuxCNC 2.9).
void bringBackLength(const Dialect &dialect, const MachineProfile &machine, MachineState &state,
                     const MachineState &was, Truth wasOn) {
  const Truth isOn = lengthOn(dialect, state);
  const bool known = wasOn != Truth::Unknown && isOn != Truth::Unknown;
  const GroupIndex lengths = dialect.group(StandardGroup::LengthOffset);
  if (known ? wasOn == isOn : lengths == noGroup || state.group(lengths) == was.group(lengths))
    return;
  Place length = storedPlace(state, dialect.zeros.length);
  if (wasOn == Truth::No ||
      state.activeAction(dialect, StandardGroup::LengthOffset) == Action::LengthOff)
    length.fill(Interval::exactly(0));
  else if (known)
    length = offsetsOfTool(machine, state, state.tool);
  else
    length[size_t(Axis::Z)] = Interval::unknown();
  storePlace(state, dialect.zeros.length, length);
}

/// What comes back of the zero point: the work offset, and whether a length and a shift over all
/// offsets are in force.
void bringBackZero(const Dialect &dialect, const MachineProfile &machine, MachineState &state,
                   const MachineState &was, const KeptModes &kept) {
  const Zero before = zeroOf(dialect, state);
  bringBackLength(dialect, machine, state, was, kept.lengthOn);
  const Interval &shiftOn = kept.presetOn;
  if (!(shiftOn == presetOn(dialect, state)))
    state.commons.set(uint64_t(dialect.zeros.presetOn), Value::of(shiftOn));
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

/// The feed comes back only where another one is in force; then the modes come back, and another
/// mode of the feed forgets the one in force (rs274 of LinuxCNC 2.9).
void bringBackFeed(const Dialect &dialect, MachineState &state, const MachineState &was,
                   const Interval &feed) {
  state.feed = feed;
  const GroupIndex modes = dialect.group(StandardGroup::FeedMode);
  if (modes == noGroup || !dialect.groups[modes].forgetsFeed ||
      state.group(modes) == was.group(modes) || !state.may(Fact::FeedSet))
    return;
  const bool aside = was.activeAction(dialect, StandardGroup::FeedMode) == Action::FeedInverseTime;
  const Interval now = aside ? was.commons.get(feedAside).asNumber() : was.feed.get();
  if (now.isConstant() && feed.isConstant()) {
    if (now == feed)
      state.clear(Fact::FeedSet);
    return;
  }
  if (state.must(Fact::FeedSet)) {
    state.clear(Fact::FeedSet);
    state.allow(bitOf(Fact::FeedSet));
  }
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
  kept.presetOn = presetOn(dialect, state);
  kept.lengthOn = lengthOn(dialect, state);
  return {std::make_shared<const KeptModes>(kept), true};
}

void bringBack(const Dialect &dialect, const MachineProfile &machine, MachineState &state,
               const SavedModes &saved) {
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
  state.factsMay = (state.factsMay & ~technologyFacts) | kept->factsMay;
  state.factsMust = (state.factsMust & ~technologyFacts) | kept->factsMust;
  bringBackFeed(dialect, state, was, kept->feed);
  state.speed = kept->speed;
  state.switches = kept->switches;
  state.spindle = kept->spindle;
  if (dialect.zeros.systems)
    bringBackZero(dialect, machine, state, was, *kept);
}

} // namespace ncvet
