// The codes that begin and end what is in force, by the names that messages and fixes give them.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// The first code of the control with that action; null when it has none.
const CodeInfo *firstCodeWith(const Dialect &dialect, Action action);
/// The radius compensation that is in force in `state`: "`G41`", or "compensation" when it may be
/// one of several.
std::string compensationName(const Dialect &dialect, const MachineState &state);
/// What ends a modal cycle: its opposite in the table, else the control's code that cancels cycles
/// ("G80") for those of drilling and for turning a rapid ("G00"), which shares the group.
std::string cancelOf(const Dialect &dialect, const CodeInfo &cycle);
/// What ends the radius compensation that is in force in `state`: the opposite of the active code,
/// else the first code of the control that switches it off. Empty for a control without one.
std::string compensationOffCode(const Dialect &dialect, const MachineState &state);
/// What ends a called program: "M99", "M17", or a word as `<RET>` where no code does. Empty for a
/// control without one.
std::string returnOf(const Dialect &dialect);
/// The same for the program of the current block: "o<name> return" in the brackets of an O-word.
std::string returnHere(const RuleContext &ctx);

} // namespace ncvet
