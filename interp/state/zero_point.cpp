// Where programmed coordinates lie on the machine, for controls that keep that in variables.
#include "interp/state/zero_point.h"

#include "interp/geometry/plane_place.h"

namespace ncvet {

namespace {

/// Keys of a copy of the selected work offset: a program that writes to its variables changes
/// nothing until it selects it again.
constexpr uint64_t selectedZero = uint64_t(1) << 38;
constexpr unsigned angle = axisCount; ///< after the axes

Interval read(const MachineState &state, uint64_t key) { return state.commons.get(key).asNumber(); }

Place plus(const Place &a, const Place &b) {
  Place sum;
  for (size_t i = 0; i < sum.size(); ++i)
    sum[i] = a[i].isUnknown() || b[i].isUnknown() ? Interval::unknown() : a[i] + b[i];
  return sum;
}

Place minus(const Place &a, const Place &b) {
  Place difference;
  for (size_t i = 0; i < difference.size(); ++i)
    difference[i] = a[i].isUnknown() || b[i].isUnknown() ? Interval::unknown() : a[i] - b[i];
  return difference;
}

} // namespace

Place turned(Place place, const Interval &degrees) {
  if (degrees == Interval::exactly(0))
    return place;
  const PlanePlace turned =
      degrees.isConstant() ? turnedPlace({place[0], place[1]}, degrees.value()) : PlanePlace();
  place[0] = turned[0];
  place[1] = turned[1];
  return place;
}

Place Zero::toMachine(const Place &programmed) const {
  return plus(plus(turned(plus(programmed, preset), degrees), system), length);
}

Place Zero::toProgrammed(const Place &machine) const {
  return minus(turned(minus(minus(machine, length), system), degrees * -1), preset);
}

Place storedPlace(const MachineState &state, int32_t first) {
  Place place;
  for (size_t i = 0; i < place.size(); ++i)
    place[i] = read(state, uint64_t(first) + i);
  return place;
}

void storePlace(MachineState &state, int32_t first, const Place &place) {
  for (size_t i = 0; i < place.size(); ++i)
    state.commons.set(uint64_t(first) + i, Value::of(place[i]));
}

Zero zeroOf(const Dialect &dialect, const MachineState &state) {
  return zeroOf(dialect.zeros, state);
}

Zero zeroOf(const ZeroVariables &zeros, const MachineState &state) {
  Zero zero;
  if (!zeros.systems)
    return zero;
  for (size_t i = 0; i < axisCount; ++i)
    zero.system[i] = read(state, selectedZero + i);
  zero.degrees = read(state, selectedZero + angle);
  zero.length = storedPlace(state, zeros.length);
  const Interval on = read(state, uint64_t(zeros.presetOn));
  if (on == Interval::exactly(0))
    zero.preset.fill(Interval::exactly(0));
  else if (on.isConstant())
    zero.preset = storedPlace(state, zeros.preset);
  return zero;
}

int32_t systemOf(const Dialect &dialect, const CodeInfo &code) {
  int32_t before = 0;
  for (const CodeIndex member : dialect.groups[code.group].members)
    before += dialect.codes[member].number < code.number;
  return before;
}

std::optional<int32_t> activeSystem(const Dialect &dialect, const MachineState &state) {
  const CodeInfo *code = state.activeCode(dialect, StandardGroup::WorkOffset);
  return code ? std::optional(systemOf(dialect, *code)) : std::nullopt;
}

void selectSystem(const Dialect &dialect, MachineState &state, int32_t system) {
  const auto first = uint64_t(dialect.zeros.systems + system * dialect.zeros.step);
  for (size_t i = 0; i <= angle; ++i)
    state.commons.set(selectedZero + i, state.commons.get(first + i));
}

Place offsetsOfTool(const MachineProfile &machine, const MachineState &state, double number) {
  Place offsets;
  offsets.fill(Interval::exactly(0));
  if (number == 0 || number == notSet)
    return offsets;
  Interval &along = offsets[size_t(Axis::Z)];
  const bool written = state.commons.given(toolTableWritten) != Truth::No;
  if (const uint64_t own = number > 0 ? toolLengthKey(int32_t(number)) : 0;
      own && !written && state.commons.given(own) != Truth::No) {
    along = state.commons.get(own).asNumber();
    return offsets;
  }
  const auto found = machine.tools.find(int(number));
  along = !written && found != machine.tools.end() && found->second.length
              ? Interval::exactly(*found->second.length)
              : Interval::unknown();
  return offsets;
}

MachineState startOn(const Dialect &dialect, const MachineProfile &machine) {
  MachineState state = initialState(dialect);
  const ZeroVariables &zeros = dialect.zeros;
  if (!zeros.systems)
    return state;
  const auto give = [&](int32_t first, const auto &origin) {
    for (size_t i = 0; i < axisCount; ++i)
      if (origin[i])
        state.commons.set(uint64_t(first) + i, Value::of(*origin[i]));
  };
  for (const CodeInfo &code : dialect.codes) {
    const auto found = machine.offsets.find(code.name);
    if (found == machine.offsets.end())
      continue;
    if (code.action == Action::WorkOffset) {
      const int32_t system = systemOf(dialect, code);
      give(zeros.systems + system * zeros.step, found->second);
      state.commons.set(uint64_t(zeros.rotation(system)), Value::of(0));
    } else if (code.action == Action::PresetPosition) {
      give(zeros.preset, found->second);
      const bool shifts =
          llvm::any_of(found->second, [](const auto &by) { return by && *by != 0; });
      state.commons.set(uint64_t(zeros.presetOn), Value::of(shifts));
    } else if (code.action == Action::ReferenceReturn && code.storedAt) {
      give(code.storedAt, found->second);
    }
  }
  if (const auto system = activeSystem(dialect, state))
    selectSystem(dialect, state, *system);
  for (size_t i = 0; i < axisCount; ++i) // no length offset is in force yet
    state.commons.set(uint64_t(zeros.length) + i, Value::of(0));
  return state;
}

/// A cycle's group may be that of motions, which callers leave as they like.
static void copyGroup(MachineState &to, const MachineState &from, const Dialect &dialect,
                      StandardGroup which) {
  if (const GroupIndex group = dialect.group(which);
      group != noGroup && group != dialect.group(StandardGroup::Motion))
    to.groups[group] = from.groups[group];
}

void copyRareModes(MachineState &to, const MachineState &from, const Dialect &dialect) {
  to.switches = from.switches;
  to.pole = from.pole;
  for (const StandardGroup which :
       {StandardGroup::Polar, StandardGroup::Rotation, StandardGroup::Scaling,
        StandardGroup::Mirror, StandardGroup::MacroModal, StandardGroup::Language,
        StandardGroup::ArcDistance, StandardGroup::Diameter})
    copyGroup(to, from, dialect, which);
}

MachineState calledState(const Dialect &dialect) {
  MachineState state = unknownState(dialect);
  const MachineState usual = initialState(dialect);
  state.clear(Fact::UnknownCode);
  state.modalCalls = nullptr;
  state.frames = usual.frames;
  if (!dialect.isLathe())
    state.liveTool = usual.liveTool;
  copyRareModes(state, usual, dialect);
  copyGroup(state, usual, dialect, StandardGroup::Cycle);
  return state;
}

} // namespace ncvet
