// What a stopped program shows of the machine.
#include "lsp/debug/state_view.h"

#include "formats/dialect/vocabulary.h"
#include "interp/state/zero_point.h"
#include "lsp/debug/watch_expression.h"

namespace ncvet::dap {

namespace {

std::string wholeText(int32_t whole) {
  return whole == notKnown ? "unknown" : std::to_string(whole);
}

/// The codes of a group that may be in force, `G00 or G01`; empty: none of them is.
std::string codesInForce(const Dialect &dialect, GroupIndex index, uint64_t may) {
  const GroupInfo &group = dialect.groups[index];
  constexpr size_t mostNames = 6; // of more nothing is known
  std::vector<std::string> names;
  for (size_t member = 0; member < group.members.size() && member < 63; ++member)
    if (may >> member & 1)
      names.push_back(dialect.codes[group.members[member]].name);
  if (names.size() > mostNames)
    return "unknown";
  if (!names.empty() && may & groupUnset)
    names.emplace_back("none");
  return llvm::join(names, " or ");
}

std::string spindleText(const MachineState &state) {
  if (state.spindle == spindleAny)
    return "unknown";
  std::vector<std::string> may;
  for (const auto &[bit, name] :
       {std::pair(spindleOff, "stopped"), std::pair(spindleCw, "clockwise"),
        std::pair(spindleCcw, "counter-clockwise"), std::pair(spindleOriented, "oriented")})
    if (state.spindle & bit)
      may.emplace_back(name);
  return llvm::join(may, " or ");
}

} // namespace

std::vector<NamedValue> modesOf(const Dialect &dialect, const MachineState &state) {
  std::vector<NamedValue> modes;
  for (GroupIndex index = 0; index < dialect.groups.size(); ++index) {
    const GroupInfo &group = dialect.groups[index];
    if (group.oneShot)
      continue;
    const uint64_t may = state.group(index);
    std::string codes = codesInForce(dialect, index, may);
    if (codes.empty())
      continue;
    const std::string name = group.title.empty() ? group.id : group.title;
    std::string title;
    for (size_t member = 0; member < group.members.size() && member < 63; ++member)
      if (may == uint64_t(1) << member)
        title = dialect.codes[group.members[member]].title;
    modes.push_back({name, std::move(codes), std::move(title)});
  }
  return modes;
}

std::vector<NamedValue> positionOf(const Dialect &dialect, const MachineState &state) {
  std::vector<NamedValue> position;
  const Place machine = zeroOf(dialect, state).toMachine(state.position);
  std::vector<NamedValue> onMachine;
  for (size_t axis = 0; axis < axisCount; ++axis) {
    const Interval &at = state.position[axis];
    const std::string name = axisNames()[axis].str();
    const bool isMain = axis < 3 && !(Axis(axis) == Axis::Y && dialect.isLathe());
    const bool told = state.machineAxes >> axis & 1;
    if (isMain || !at.isUnknown())
      position.push_back({name, told ? "unknown" : valueText(at), ""});
    if (const Interval &there = told ? at : machine[axis]; !there.isUnknown())
      onMachine.push_back({"machine " + name, valueText(there), ""});
  }
  llvm::append_range(position, onMachine);
  return position;
}

std::vector<NamedValue> offsetsOf(const Dialect &dialect, const MachineState &state) {
  std::vector<NamedValue> offsets;
  const auto add = [&](llvm::StringRef name, int32_t value) {
    if (value != notSet)
      offsets.push_back({name.str(), wholeText(value), ""});
  };
  add("tool", state.tool);
  add("next tool", state.preselected);
  add("tool offset", state.toolOffset);
  add("length offset H", state.lengthOffset);
  add("radius offset D", state.radiusOffset);
  if (const GroupIndex group = dialect.group(StandardGroup::WorkOffset); group != noGroup)
    if (std::string codes = codesInForce(dialect, group, state.group(group)); !codes.empty())
      offsets.push_back({"zero point", std::move(codes), ""});
  const Zero zero = zeroOf(dialect, state);
  const auto shift = [&](llvm::StringRef what, const Place &place) {
    for (size_t axis = 0; axis < 3; ++axis)
      if (!place[axis].isUnknown())
        offsets.push_back({(what + " " + axisNames()[axis]).str(), valueText(place[axis]), ""});
  };
  shift("zero point", zero.system);
  shift("shift", zero.preset);
  shift("length", zero.length);
  return offsets;
}

std::vector<NamedValue> drivesOf(const Dialect &dialect, const MachineState &state) {
  std::vector<NamedValue> drives;
  drives.push_back({"spindle", spindleText(state), ""});
  if (state.may(Fact::SpeedSet))
    drives.push_back({"S", valueText(state.speed), ""});
  if (!state.speedLimit->isUnknown())
    drives.push_back({"speed at most", valueText(state.speedLimit), ""});
  if (state.may(Fact::FeedSet))
    drives.push_back({"F", valueText(state.feed), ""});
  for (size_t i = 0; i < dialect.switches.size(); ++i)
    if (state.switchMayBeOn(unsigned(i)))
      drives.push_back(
          {dialect.switches[i].title, state.switchMustBeOn(unsigned(i)) ? "on" : "unknown", ""});
  return drives;
}

} // namespace ncvet::dap
