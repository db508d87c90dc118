// The passes of a thread that is cut by a list of diameters.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// Diameters of the passes that come after the current block in the list of its thread cycle, in
/// units of the program, as far as they are written as numbers; increments count from `from`, the
/// start of the cycle.
llvm::SmallVector<double, 8> threadPassesAhead(const RuleContext &ctx, double from);

} // namespace ncvet
