// What the modes in force say of axes, planes and diameters.
#include "interp/state/modes.h"

namespace ncvet {

namespace {
constexpr uint16_t axisBit(Axis axis) { return uint16_t(1u << unsigned(axis)); }
} // namespace

bool inForeignLanguage(const Dialect &dialect, const MachineState &state) {
  const GroupIndex group = dialect.group(StandardGroup::Language);
  if (group == noGroup || dialect.groups[group].initial == 0xFF)
    return false;
  const uint64_t own = uint64_t(1) << dialect.groups[group].initial;
  return !(state.group(group) & groupUnset) && (state.group(group) & ~own);
}

uint16_t planeAxes(const Dialect &dialect, const MachineState &state) {
  switch (state.activeAction(dialect, StandardGroup::Plane)) {
  case Action::PlaneXY:
    return axisBit(Axis::X) | axisBit(Axis::Y);
  case Action::PlaneZX:
    return axisBit(Axis::Z) | axisBit(Axis::X);
  case Action::PlaneYZ:
    return axisBit(Axis::Y) | axisBit(Axis::Z);
  default:
    // A plane of rotary axes is none of the three: any axis but the tool's may lie in it.
    if (state.activeCode(dialect, StandardGroup::Plane))
      return uint16_t(((1u << axisCount) - 1) & ~axisBit(toolAxis(dialect, state)));
    return dialect.isLathe() ? axisBit(Axis::Z) | axisBit(Axis::X)
                             : axisBit(Axis::X) | axisBit(Axis::Y);
  }
}

std::array<Axis, 2> planeOrder(const Dialect &dialect, const MachineState &state) {
  const uint16_t axes = planeAxes(dialect, state);
  const bool x = axes & axisBit(Axis::X), y = axes & axisBit(Axis::Y);
  const std::array usual = x && y ? std::array{Axis::X, Axis::Y}
                           : x    ? std::array{Axis::Z, Axis::X}
                                  : std::array{Axis::Y, Axis::Z};
  const CodeInfo *code = state.activeCode(dialect, StandardGroup::Plane);
  return code && code->firstAxis == unsigned(usual[1]) ? std::array{usual[1], usual[0]} : usual;
}

Axis toolAxis(const Dialect &dialect, const MachineState &state) {
  switch (state.activeAction(dialect, StandardGroup::Plane)) {
  case Action::PlaneXY:
    return Axis::Z;
  case Action::PlaneZX:
    return dialect.isLathe() ? Axis::Z : Axis::Y;
  case Action::PlaneYZ:
    return Axis::X;
  default:
    return Axis::Z;
  }
}

uint16_t axesOf(const Dialect &dialect, const Block &block) {
  uint16_t axes = 0;
  if (!block.hasAny(dialect.axisWords))
    return 0;
  for (const Word &word : block.words) {
    const AddressInfo &address = dialect.addresses[word.address];
    if (address.kind == AddressKind::Axis || address.kind == AddressKind::Increment)
      axes |= axisBit(address.axis);
  }
  return axes;
}

Interval shareOfDiameter(const Dialect &dialect, const MachineState &state, Axis axis,
                         Truth increment) {
  if (axis != Axis::X || dialect.group(StandardGroup::Diameter) == noGroup)
    return Interval::exactly(1);
  // Where the program has stated nothing, words are what they are on a mill.
  bool half = false, whole = state.active(dialect, StandardGroup::Diameter) & groupUnset;
  for (const CodeInfo *code : state.candidates(dialect, StandardGroup::Diameter)) {
    const bool absolute = code->action == Action::DiameterAbsolute;
    half |= code->action == Action::DiameterOn || (absolute && increment != Truth::Yes);
    whole |= absolute ? increment != Truth::No : code->action != Action::DiameterOn;
  }
  return half && whole ? Interval::unknown() : Interval::exactly(half ? 0.5 : 1);
}

} // namespace ncvet
