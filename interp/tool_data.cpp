// Which tool compensation works with, how large it is, and on which side of the path it runs.
#include "interp/tool_data.h"

#include "formats/dialect/variable_key.h"
#include "interp/execute.h"

namespace ncvet {

namespace {

/// "$TC_DP6[{tool},{edge}]" with the numbers of `state`; empty when one is not known.
std::string radiusVariable(const Dialect &dialect, const MachineState &state) {
  std::string name;
  for (llvm::StringRef rest = dialect.toolRadius.variable; !rest.empty();) {
    const auto [before, from] = rest.split('{');
    name += before;
    const auto [field, behind] = from.split('}');
    rest = behind;
    if (field.empty())
      continue;
    const int32_t offset = radiusOffsetNumber(dialect, state);
    const bool given = offset != notSet;
    const int32_t number = field == "tool" || (field == "offsetOrTool" && !given) ? state.tool
                           : field == "edge" && !given ? 1 // a tool's first one
                                                       : offset;
    if (number < 0)
      return {};
    name += std::to_string(number);
  }
  return name;
}

} // namespace

const ToolData *compensatingTool(const Dialect &dialect, const MachineProfile &machine,
                                 const MachineState &state) {
  int32_t number = radiusOffsetNumber(dialect, state);
  if (dialect.offsetsOfTool) {
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

std::optional<double> compensationRadius(const Dialect &dialect, const MachineProfile &machine,
                                         const MachineState &state) {
  const ToolRadiusSource &source = dialect.toolRadius;
  if (source.unknownWhile != 0xFF && state.switchMayBeOn(source.unknownWhile))
    return std::nullopt;
  if (!source.variable.empty() && !state.commons.empty()) {
    const llvm::StringRef list = llvm::StringRef(source.variable).split('[').first;
    if (state.commons.given(variableKey(list)) != Truth::No)
      return std::nullopt; // some of them was set, it is not known which one
    const std::string name = radiusVariable(dialect, state);
    if (const uint64_t key = variableKey(name);
        !name.empty() && state.commons.given(key) != Truth::No) {
      const Value value = state.commons.get(key);
      if (!value.isConstant() || state.activeAction(dialect, StandardGroup::Units) == Action::Inch)
        return std::nullopt; // in which unit it was set is not kept
      return value.number.value();
    }
  }
  const ToolData *tool = compensatingTool(dialect, machine, state);
  return tool ? tool->radius : std::nullopt;
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
