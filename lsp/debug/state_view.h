// What a stopped program shows of the machine: groups of names and values, as plain data.
#pragma once

#include "analyzer/program/project.h"

#include <string>
#include <vector>

namespace ncvet {
struct MachineState; // interp/state/state.h
}

namespace ncvet::dap {

/// A name with its value, both for people.
struct NamedValue {
  std::string name, value;
  std::string type; ///< what it is, for a hint; may be empty
};

/// Modal groups of the control that may have a code in force: title of the group, the codes.
std::vector<NamedValue> modesOf(const Dialect &dialect, const MachineState &state);
/// Axes with their coordinates, mm and degrees, X of a lathe as programmed; where the machine's
/// coordinates are known these too: `machine X`.
std::vector<NamedValue> positionOf(const Dialect &dialect, const MachineState &state);
/// Tool, offsets of length and radius, shifts of the zero point.
std::vector<NamedValue> offsetsOf(const Dialect &dialect, const MachineState &state);
/// What the spindle does, its speed, the feed, and what is switched on.
std::vector<NamedValue> drivesOf(const Dialect &dialect, const MachineState &state);

} // namespace ncvet::dap
