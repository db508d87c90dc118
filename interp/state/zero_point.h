// Where programmed coordinates lie on the machine, for controls that keep that in variables.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/geometry/move.h"
#include "interp/state/state.h"

namespace ncvet {

/// The zero point in force. Its coordinates lead to the machine's in this order: the preset shift,
/// the angle in the XY plane, the work offset, the length of the tool.
struct Zero {
  Place preset, system, length;
  Interval degrees; ///< of the work offset

  Place toMachine(const Place &programmed) const;
  Place toProgrammed(const Place &machine) const;
};

/// Key of the feed that was in force before the feed of inverse times, which leaves it aside.
constexpr uint64_t feedAside = (uint64_t(1) << 38) + 99;
/// Key under which is kept that the program has written into the list of tools: no program's.
constexpr uint64_t toolTableWritten = (uint64_t(1) << 38) + 100;
/// Key of the length (mm) that the program has given a tool.
constexpr uint64_t toolLengthKey(int32_t tool) { return toolTableWritten + 1 + uint64_t(tool); }

/// X and Y of `place` turned counter-clockwise about Z; not known where the angle is not.
Place turned(Place place, const Interval &degrees);

/// The zero point in force; all of it unknown for a control that keeps it elsewhere.
Zero zeroOf(const ZeroVariables &zeros, const MachineState &state);
Zero zeroOf(const Dialect &dialect, const MachineState &state);

/// Coordinates on the machine of the place that the variables from `first` on hold.
Place storedPlace(const MachineState &state, int32_t first);
void storePlace(MachineState &state, int32_t first, const Place &place);

/// Number of the work offset that a code selects, from 0: by the order of their codes.
int32_t systemOf(const Dialect &dialect, const CodeInfo &code);
/// Number of the work offset in force; none when it is not certain.
std::optional<int32_t> activeSystem(const Dialect &dialect, const MachineState &state);
/// Puts into force what the variables say of a work offset.
void selectSystem(const Dialect &dialect, MachineState &state, int32_t system);

/// The offsets of a tool (mm), 0: of none, as the program or the machine's profile gives them.
Place offsetsOfTool(const MachineProfile &machine, const MachineState &state, double number);

/// State at the start of a program on that machine: as `initialState`, with the offsets that the
/// profile knows.
MachineState startOn(const Dialect &dialect, const MachineProfile &machine);

/// Copies what changes the meaning of all words and is seldom on: polar coordinates, scaling,
/// mirror, diameters, other such switches.
void copyRareModes(MachineState &to, const MachineState &from, const Dialect &dialect);

/// State on entry of a program that others call, where no caller is known: one that calls it as
/// most would. What a caller sets for it is not known (tool, speed, feed, units, plane, place,
/// compensation); what changes the meaning of all words (polar coordinates, scaling, frames, modal
/// cycles and calls, diameters, other such switches, codes that nobody knows) is as at power-on, as
/// nothing that the program sets itself would be known else.
MachineState calledState(const Dialect &dialect);

} // namespace ncvet
