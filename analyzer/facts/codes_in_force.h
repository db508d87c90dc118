// Modal groups of which another code than the usual one may be in force.
#pragma once

#include "formats/dialect/dialect.h"
#include "interp/state/state.h"

namespace ncvet {

/// Whether a code of the group named `id` in the table may be in force that is neither the one of
/// power-on nor one that ends what the group does. False where the table has no such group.
inline bool mayBeUnusual(const Dialect &dialect, const MachineState &state, llvm::StringRef id,
                         bool (*usual)(const CodeInfo &code)) {
  for (size_t group = 0; group < dialect.groups.size(); ++group) {
    if (dialect.groups[group].id != id)
      continue;
    const uint64_t active = state.group(GroupIndex(group));
    const auto &members = dialect.groups[group].members;
    for (size_t i = 0; i < members.size(); ++i)
      if ((active >> i & 1) && !usual(dialect.codes[members[i]]))
        return true;
  }
  return false;
}

/// Whether coordinates may be others than those of the machine's axes (`transformation`).
inline bool mayBeTransformed(const Dialect &dialect, const MachineState &state) {
  return mayBeUnusual(dialect, state, "transformation",
                      [](const CodeInfo &code) { return code.action == Action::None; });
}

/// Whether the tool was changed after compensation was switched on: that it is still on was told
/// there, and what else it does from then on has the same cause.
inline bool outlivesTool(const MachineState &state) {
  return state.origin.isOlderThanTool(StatePart::Compensation);
}

/// Whether the tool was changed while the cycle in force was on already: told there.
inline bool cycleOutlivesTool(const MachineState &state) {
  return state.origin.isOlderThanTool(StatePart::Cycle);
}

/// Whether X is certainly a diameter: the work turns, and the tool axis is none that goes into it.
inline bool turnsWork(const Dialect &dialect, const MachineState &state) {
  return state.isActive(dialect, StandardGroup::Diameter,
                        {Action::DiameterOn, Action::DiameterAbsolute}) == Truth::Yes;
}

/// Millimetres of the diameter per unit of X in a state: where X is not a diameter by nature, a
/// state has it as a radius.
inline double diameterFactor(const Dialect &dialect) {
  constexpr double both = 2; // sides
  return both / dialect.lengthsPerUnit(Axis::X);
}

} // namespace ncvet
