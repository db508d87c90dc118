// Boxes that a tool may hit: stock and clamps of the machine profile.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/geometry/move.h"

namespace ncvet {

/// Whether the straight way of the tool's tip from one place to another leads through the inside of
/// the box. Unknown as soon as a coordinate that decides it is not known; places are in the work
/// coordinates of the machine profile, millimetres.
Truth leadsThrough(const Stock &box, const Place &from, const Place &to);

} // namespace ncvet
