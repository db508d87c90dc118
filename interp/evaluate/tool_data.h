// Which tool compensation works with, how large it is, and on which side of the path it runs.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/state/state.h"

namespace ncvet {

/// Number of the offset that holds radius and tip: D on mills, the second half of T on lathes.
inline int32_t radiusOffsetNumber(const Dialect &dialect, const MachineState &state) {
  return dialect.isLathe() ? state.toolOffset : state.radiusOffset;
}

/// Whether the number beside the code that switches compensation on is that of a tool, and counts
/// for that code alone.
bool cutterOfBlock(const Dialect &dialect);

/// Data of the tool whose radius compensation uses, by the offset's number or, where the tool
/// brings its data along, by its own; null when the number is not known or not in the
/// list.
const ToolData *compensatingTool(const Dialect &dialect, const MachineProfile &machine,
                                 const MachineState &state);

/// Data of the tool in use, or null.
const ToolData *toolInUse(const MachineProfile &machine, const MachineState &state);

/// The radius (mm) that compensation uses, below zero for the other side: as the program itself set
/// it, else that of the machine's tool; none when it is not known.
std::optional<double> compensationRadius(const Dialect &dialect, const MachineProfile &machine,
                                         const MachineState &state);

/// 1 when the tool's centre runs on the left of the path that compensation in `state` follows, -1
/// on its right, 0 when that is not certain. In coordinates in which all frames are resolved.
int8_t compensatedSide(const Dialect &dialect, const MachineState &state);

} // namespace ncvet
