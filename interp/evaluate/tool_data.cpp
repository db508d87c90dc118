// Which tool compensation works with, how large it is, and on which side of the path it runs.
#include "interp/evaluate/tool_data.h"

#include "formats/dialect/variable_key.h"
#include "interp/state/modes.h"
#include "interp/value/units.h"

namespace ncvet {

namespace {

/// The number that a field of a variable's name has; below 0: it is not known.
int32_t numberFor(llvm::StringRef field, const Dialect &dialect, const MachineState &state) {
  const int32_t offset = radiusOffsetNumber(dialect, state);
  const bool given = offset != notSet;
  return field == "tool" || (field == "offsetOrTool" && !given) ? state.tool.get()
         : field == "edge" && !given                            ? 1 // a tool's first one
                                                                : offset;
}

/// The key of "$TC_DP6[{tool},{edge}]" with the numbers of `state`; none when one is not known.
std::optional<uint64_t> keyIn(const ToolRadiusSource::Place &place, const Dialect &dialect,
                              const MachineState &state) {
  std::string name;
  for (llvm::StringRef rest = place.name; !rest.empty();) {
    const auto [before, from] = rest.split('{');
    const auto [field, after] = from.split('}');
    rest = after;
    const int32_t number = field.empty() ? 0 : numberFor(field, dialect, state);
    if (number < 0)
      return std::nullopt;
    if (size_t(number) < place.keys.size()) // it is the only field
      return place.keys[size_t(number)];
    name += before;
    if (!field.empty())
      name += std::to_string(number);
  }
  return variableKey(name);
}

/// What a program has set a radius to.
struct SetRadius {
  bool set = false;
  std::optional<double> radius; ///< mm; none: not known
};

/// The radius in the variable.
SetRadius radiusIn(const ToolRadiusSource::Place &place, const Dialect &dialect,
                   const MachineState &state) {
  if (place.isList && state.commons.given(place.key) != Truth::No)
    return {true, std::nullopt}; // some of them was set, it is not known which one
  const std::optional<uint64_t> key =
      place.isPlain && !place.isList ? std::optional(place.key) : keyIn(place, dialect, state);
  if (!key || state.commons.given(*key) == Truth::No)
    return {};
  const Value value = state.commons.get(*key);
  const bool inch = state.activeAction(dialect, StandardGroup::Units) == Action::Inch;
  // In which unit one of a list was set is not kept.
  if (!value.isConstant() || (inch && place.isList))
    return {true, std::nullopt};
  return {true, value.number.value() * (inch ? millimetresPerInch : 1)};
}

} // namespace

bool cutterOfBlock(const Dialect &dialect) {
  const auto option = dialect.options.find("compensationTool");
  return option != dialect.options.end() && option->second == "of-block";
}

const ToolData *compensatingTool(const Dialect &dialect, const MachineProfile &machine,
                                 const MachineState &state) {
  if (machine.tools.empty())
    return nullptr;
  int32_t number = radiusOffsetNumber(dialect, state);
  if (cutterOfBlock(dialect)) {
    number = number == notSet ? state.tool.get() : number;
  } else if (dialect.offsetsOfTool) {
    // The list knows a tool's first edge.
    if (number != notSet && number != 1)
      return nullptr;
    number = state.tool;
  }
  const auto found = machine.tools.find(number);
  return found == machine.tools.end() ? nullptr : &found->second;
}

const ToolData *toolInUse(const MachineProfile &machine, const MachineState &state) {
  const auto found = machine.tools.find(state.tool);
  return found == machine.tools.end() ? nullptr : &found->second;
}

namespace {
/// The stock, in mm, that is added to the radius; none: not known.
std::optional<double> allowanceOf(const Dialect &dialect, const MachineState &state) {
  const uint64_t key = dialect.toolRadius.allowanceKey;
  if (dialect.toolRadius.allowance.empty() || state.commons.given(key) == Truth::No)
    return 0;
  const Value value = state.commons.get(key);
  return value.isConstant() ? std::optional(value.number.value()) : std::nullopt;
}

std::optional<double> radiusOfTool(const Dialect &dialect, const MachineProfile &machine,
                                   const MachineState &state) {
  if (state.commons.mayBeGivenFrom(firstNamedVariable))
    for (const ToolRadiusSource::Place &place : dialect.toolRadius.places)
      if (const SetRadius found = radiusIn(place, dialect, state); found.set)
        return found.radius;
  const ToolData *tool = compensatingTool(dialect, machine, state);
  return tool ? tool->radius : std::nullopt;
}
} // namespace

std::optional<double> compensationRadius(const Dialect &dialect, const MachineProfile &machine,
                                         const MachineState &state) {
  if (machine.tools.empty() && (dialect.toolRadius.variable.empty() || state.commons.empty()))
    return std::nullopt; // nothing says it
  const auto radius = radiusOfTool(dialect, machine, state);
  const auto allowance = radius ? allowanceOf(dialect, state) : std::nullopt;
  return allowance ? std::optional(*radius + *allowance) : std::nullopt;
}

int8_t compensatedSide(const Dialect &dialect, const MachineState &state) {
  const Action action = state.activeAction(dialect, StandardGroup::Compensation);
  int8_t side = action == Action::CompensationLeft    ? 1
                : action == Action::CompensationRight ? -1
                                                      : 0;
  if (!side || state.frames.empty())
    return side;
  const auto total = state.frames.total();
  if (!total)
    return 0;
  // A mirrored contour is cut on its other side.
  const std::array<Axis, 2> plane = planeOrder(dialect, state);
  const auto a = size_t(plane[0]), b = size_t(plane[1]);
  const auto &turn = total->turn;
  const bool mirrored = turn[a][a] * turn[b][b] - turn[a][b] * turn[b][a] < 0;
  return mirrored ? int8_t(-side) : side;
}

} // namespace ncvet
