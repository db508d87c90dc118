// Codes that move the zero point of a control that keeps it in variables: work offsets, G10, G92,
// tool lengths, and the moves that lead to places on the machine.
#include "interp/execute/execution.h"
#include "interp/state/zero_point.h"

namespace ncvet {

/// The work offset in force was moved, and the tool has other coordinates. The shift of G92 does
/// not count: LinuxCNC lets it go along.
void Execution::systemMoved(const Zero &before) {
  const auto systemOnly = [](Zero zero) {
    zero.preset.fill(Interval::exactly(0));
    zero.length.fill(Interval::exactly(0));
    return zero;
  };
  const Zero from = systemOnly(before), to = systemOnly(zeroOf(dialect_, state_));
  moveTo(to.toProgrammed(from.toMachine(known())));
}

/// Coordinates of the tool, without those that are the machine's.
std::array<Interval, axisCount> Execution::known() const {
  Place place = state_.position;
  for (size_t i = 0; i < axisCount; ++i)
    if (state_.machineAxes >> i & 1)
      place[i] = Interval::unknown();
  return place;
}

/// Gives the tool these coordinates, but for axes of which those on the machine are known.
void Execution::moveTo(const std::array<Interval, axisCount> &place) {
  state_.fedFrom.forget();
  for (size_t i = 0; i < axisCount; ++i)
    if (!(state_.machineAxes >> i & 1))
      state_.position[i] = place[i];
}

/// Work offsets and tool lengths of the block take effect before it moves.
void Execution::applyZeros() {
  if (!dialect_.zeros.systems)
    return;
  for (const CodeUse &use : outcome_.codes)
    applyLength(use);
  for (const CodeUse &use : outcome_.codes)
    if (const CodeInfo &code = info(use); code.action == Action::WorkOffset) {
      const Zero before = zeroOf(dialect_, state_);
      selectSystem(dialect_, state_, systemOf(dialect_, code));
      moveTo(zeroOf(dialect_, state_).toProgrammed(before.toMachine(known())));
    }
}

/// G43, G43.1, G43.2 and G49.
void Execution::applyLength(const CodeUse &use) {
  const CodeInfo &code = info(use);
  const int32_t first = dialect_.zeros.length;
  const Place before = storedPlace(state_, first);
  Place length = before;
  const auto given = [&](bool adds) {
    for (const Word &word : block_.words)
      if (dialect_.axisWords & maskOf(word.address)) {
        Interval &axis = length[size_t(dialect_.addresses[word.address].axis)];
        axis = adds ? axis + coordinate(word) : coordinate(word);
      }
  };
  switch (code.action) {
  case Action::LengthPositive:
    length = lengthOfTool();
    break;
  case Action::LengthSet:
    given(false);
    break;
  case Action::LengthAdd:
    if (block_.has(letterAddress('H'))) {
      const Place more = lengthOfTool();
      for (size_t i = 0; i < axisCount; ++i)
        length[i] = length[i] + more[i];
    } else {
      given(true);
    }
    break;
  case Action::LengthOff:
    length.fill(Interval::exactly(0));
    break;
  default:
    return;
  }
  storePlace(state_, first, length);
  Place place = known();
  for (size_t i = 0; i < axisCount; ++i)
    if (!(before[i] == length[i] && length[i].isConstant()))
      place[i] = before[i].isUnknown() || length[i].isUnknown() ? Interval::unknown()
                                                                : place[i] + before[i] - length[i];
  moveTo(place);
}

/// What is known of the length of the tool that H names, or of the one in the spindle.
std::array<Interval, axisCount> Execution::lengthOfTool() const {
  double number = state_.tool;
  if (const Word *h = block_.find('H')) {
    const Interval v = value(*h);
    number = v.isConstant() ? v.value() : notKnown;
  }
  return offsetsOfTool(machine_, state_, number);
}

/// G10 L1, L10 and L11 give a tool its length, which a later G43 takes (LinuxCNC 2.9, sections
/// 11.5.13 to 11.5.16): itself, or so that the tool has this coordinate in the system in force, or
/// in the last one without the shift of G92.
void Execution::setToolLength() {
  const Word *form = block_.find('L'), *p = block_.find('P'), *z = block_.find('Z');
  const Interval number = p ? value(*p) : Interval::unknown();
  const Interval which = form ? value(*form) : Interval::unknown();
  const bool others = llvm::any_of(block_.words, [&](const Word &word) {
    return (dialect_.axisWords & maskOf(word.address)) &&
           dialect_.addresses[word.address].axis != Axis::Z;
  });
  if (!which.isConstant() || !number.isConstant() || number.value() < 1 || others) {
    state_.commons.set(toolTableWritten, Value::of(1));
    return;
  }
  if (!z)
    return;
  constexpr auto along = size_t(Axis::Z);
  constexpr double itself = 1, here = 10;
  const Zero zero = zeroOf(dialect_, state_);
  Interval length = coordinate(*z);
  if (which.value() == here) {
    length = zero.length[along] + known()[along] - length;
  } else if (which.value() != itself) {
    constexpr int32_t last = 8; // of the work offsets
    const Place origin = storedPlace(state_, dialect_.zeros.systems + last * dialect_.zeros.step);
    length = zero.toMachine(known())[along] - origin[along] - length;
  }
  state_.commons.set(toolLengthKey(int32_t(number.value())), Value::of(length));
}

/// G10 L2 and L20: where a work offset lies, or what coordinates the tool has in it.
void Execution::setSystem(const CodeUse &use) {
  const ZeroVariables &zeros = dialect_.zeros;
  const auto active = activeSystem(dialect_, state_);
  const Word *p = block_.find('P');
  const Interval number = p ? value(*p) : Interval::unknown();
  std::optional<int32_t> system = active;
  if (!number.isConstant())
    system.reset();
  else if (number.value() >= 1)
    system = int32_t(number.value()) - 1;
  if (!system) { // it may be any of them
    state_.commons.forget();
    return moveTo({});
  }
  const int32_t first = zeros.systems + *system * zeros.step;
  const Zero before = zeroOf(dialect_, state_);
  const bool here = info(use).action == Action::ZeroHere;
  if (const Word *r = block_.find('R'))
    state_.commons.set(uint64_t(zeros.rotation(*system)), Value::of(value(*r)));
  Place origin = storedPlace(state_, first);
  Place there = known(); // coordinates of the tool in that system
  if (here && system != active) {
    Zero target = before;
    target.system = origin;
    target.degrees = state_.commons.get(uint64_t(zeros.rotation(*system))).asNumber();
    there = target.toProgrammed(before.toMachine(there));
  }
  Place change;
  change.fill(Interval::exactly(0));
  for (const Word &word : block_.words) {
    if (!(dialect_.axisWords & maskOf(word.address)))
      continue;
    const auto axis = size_t(dialect_.addresses[word.address].axis);
    if (here)
      change[axis] = there[axis].isUnknown() ? Interval::unknown() : there[axis] - coordinate(word);
    else
      origin[axis] = coordinate(word);
  }
  if (here) {
    change = turned(change, state_.commons.get(uint64_t(zeros.rotation(*system))).asNumber());
    for (size_t i = 0; i < axisCount; ++i)
      origin[i] = origin[i].isUnknown() || change[i].isUnknown() ? Interval::unknown()
                                                                 : origin[i] + change[i];
  }
  storePlace(state_, first, origin);
  if (system != active)
    return;
  selectSystem(dialect_, state_, *system);
  systemMoved(before);
  if (here)
    for (const Word &word : block_.words)
      if (dialect_.axisWords & maskOf(word.address)) {
        const Axis axis = dialect_.addresses[word.address].axis;
        state_.at(axis) = coordinate(word); // also under G91
        state_.machineAxes &= ~(1u << unsigned(axis));
      }
}

/// G92 and G52: the shift over all work offsets.
void Execution::setPreset(bool local) {
  const ZeroVariables &zeros = dialect_.zeros;
  const Place before = zeroOf(dialect_, state_).preset;
  Place preset = before, place = known();
  for (const Word &word : block_.words) {
    if (!(dialect_.axisWords & maskOf(word.address)))
      continue;
    const auto axis = size_t(dialect_.addresses[word.address].axis);
    const Interval given = coordinate(word);
    const auto sum = [](const Interval &a, const Interval &b, const Interval &c) {
      return a.isUnknown() || b.isUnknown() || c.isUnknown() ? Interval::unknown() : a + b - c;
    };
    preset[axis] = local ? given : sum(place[axis], before[axis], given);
    place[axis] = local ? sum(place[axis], before[axis], given) : given;
    if (!local)
      state_.machineAxes &= ~(1u << axis);
  }
  storePlace(state_, zeros.preset, preset);
  state_.commons.set(uint64_t(zeros.presetOn), Value::of(1));
  moveTo(place);
}

/// G92.1, G92.2 and G92.3.
void Execution::switchPreset(Action action) {
  const ZeroVariables &zeros = dialect_.zeros;
  const Place before = zeroOf(dialect_, state_).preset;
  if (action == Action::PresetClear) {
    Place none;
    none.fill(Interval::exactly(0));
    storePlace(state_, zeros.preset, none);
  }
  state_.commons.set(uint64_t(zeros.presetOn), Value::of(action == Action::PresetRestore));
  const Place now = zeroOf(dialect_, state_).preset;
  Place place = known();
  for (size_t i = 0; i < axisCount; ++i)
    place[i] = before[i].isUnknown() || now[i].isUnknown() ? Interval::unknown()
                                                           : place[i] + before[i] - now[i];
  moveTo(place);
}

/// Axes whose place on the machine is known get their coordinates, where it is known how these lie.
void Execution::fromMachine() {
  if (!dialect_.zeros.systems)
    return;
  const Zero zero = zeroOf(dialect_, state_);
  Place programmed = before_.position;
  for (size_t i = 0; i < axisCount; ++i)
    if (before_.machineAxes >> i & 1)
      programmed[i] = Interval::unknown();
  Place machine = zero.toMachine(programmed);
  for (size_t i = 0; i < axisCount; ++i)
    if (state_.machineAxes >> i & 1)
      machine[i] = state_.position[i];
    else if (before_.machineAxes >> i & 1)
      machine[i] = before_.position[i];
  const Place place = zero.toProgrammed(machine);
  const bool turns = !(zero.degrees == Interval::exactly(0));
  for (size_t i = 0; i < axisCount; ++i) {
    const bool onMachine = state_.machineAxes >> i & 1;
    if (place[i].isUnknown() ? !onMachine && turns && i < 2 : onMachine || turns)
      state_.position[i] = place[i];
    if (!place[i].isUnknown())
      state_.machineAxes &= ~(1u << i);
  }
}

} // namespace ncvet
