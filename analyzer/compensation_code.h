// The code that ends radius compensation, for messages and fixes.
#pragma once

#include "analyzer/rule.h"

namespace ncvet {

/// What ends the compensation that is in force in `state`: the code that the table names as the
/// opposite of the active one, else the first one of the control that switches it off.
inline std::string compensationOffCode(const Dialect &dialect, const MachineState &state) {
  const CodeInfo *active = state.activeCode(dialect, StandardGroup::Compensation);
  if (active && active->opposite != noCode)
    return dialect.codes[active->opposite].name;
  const GroupIndex group = dialect.group(StandardGroup::Compensation);
  if (group != noGroup)
    for (const CodeIndex member : dialect.groups[group].members)
      if (dialect.codes[member].action == Action::CompensationOff)
        return dialect.codes[member].name;
  return "G40";
}

} // namespace ncvet
