// The codes that end what is in force, for messages and fixes.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// What ends a modal cycle: its opposite in the table, else the control's code that cancels cycles
/// ("G80") for those of drilling and for turning a rapid ("G00"), which shares the group.
std::string cancelOf(const Dialect &dialect, const CodeInfo &cycle);
/// What ends the radius compensation that is in force in `state`: the opposite of the active code,
/// else the first code of the control that switches it off. Empty for a control without one.
std::string compensationOffCode(const Dialect &dialect, const MachineState &state);
/// What ends a called program: "M99", "M17", or a word as `<RET>` where no code does. Empty for a
/// control without one.
std::string returnOf(const Dialect &dialect);

} // namespace ncvet
