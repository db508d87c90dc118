// Which entry of the profile's tool list compensation works with.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/state.h"

namespace ncvet {

/// Number of the offset that holds radius and tip: D on mills, the second half of T on lathes.
inline int32_t radiusOffsetNumber(const Dialect &dialect, const MachineState &state) {
  return dialect.isLathe() ? state.toolOffset : state.radiusOffset;
}

/// Data of the tool whose radius compensation uses, by the offset's number or, where the tool
/// brings its data along, by its own; null when the number is not known or not in the
/// list.
inline const ToolData *compensatingTool(const Dialect &dialect, const MachineProfile &machine,
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

/// Data of the tool in use, or null.
inline const ToolData *toolInUse(const MachineProfile &machine, const MachineState &state) {
  const auto found = machine.tools.find(state.tool);
  return found == machine.tools.end() ? nullptr : &found->second;
}

} // namespace ncvet
