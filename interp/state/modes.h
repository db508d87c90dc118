// What the modes in force say of axes, planes and diameters.
#pragma once

#include "formats/readers/block.h"
#include "interp/state/state.h"

namespace ncvet {

/// Whether the text is read, or may be, in the language of another control.
bool inForeignLanguage(const Dialect &dialect, const MachineState &state);
/// Axes of the active plane as a bit mask over `Axis`; the usual plane of the machine's kind when
/// no plane code was stated.
uint16_t planeAxes(const Dialect &dialect, const MachineState &state);
/// Axes of the active plane in the order in which angles count, from the first to the second: X Y,
/// Z X or Y Z.
std::array<Axis, 2> planeOrder(const Dialect &dialect, const MachineState &state);
/// Axis normal to the active plane: the axis along which a drilling cycle drills.
Axis toolAxis(const Dialect &dialect, const MachineState &state);
/// What a word of the axis counts for its coordinate: half where codes have made X a diameter, for
/// coordinates or for increments too. Unknown where they may have.
Interval shareOfDiameter(const Dialect &dialect, const MachineState &state, Axis axis,
                         Truth increment);
/// Bit mask over `Axis` of the axes that the block's words name.
uint16_t axesOf(const Dialect &dialect, const Block &block);

} // namespace ncvet
