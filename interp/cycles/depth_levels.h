// The levels on which a milling cycle works, from its top to its bottom.
#pragma once

#include "interp/evaluate/cycle_parameters.h"

namespace ncvet {

/// Levels along the tool axis, the last one at the bottom; none when the table does not say where
/// the cycle works. Of steps that are at most so deep only the number of levels is known.
llvm::SmallVector<Interval, 8> depthLevels(const CycleParameters &parameters);

/// Level from which the tool is fed, and that to which it is withdrawn.
std::optional<Interval> approachLevel(const CycleParameters &parameters);
std::optional<Interval> backLevel(const CycleParameters &parameters);

} // namespace ncvet
