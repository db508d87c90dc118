// Whether a program that states no plane is one for a lathe.
#pragma once

#include "analyzer/program/project.h"

namespace ncvet {

/// On a control for mills and lathes the machine's data say which plane holds at the start. True:
/// the program states none, moves X and Z and no Y, and has what only a lathe has (diameters, a
/// limit of the speed, cutting speed, a contour that is turned, an arc with K). Reads the program's
/// first blocks.
bool readsAsTurning(const FileUnit &unit, const ProgramInfo &program);

} // namespace ncvet
