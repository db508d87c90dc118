// The direction in which the move before the current block ends, as far as the text tells it.
#pragma once

#include "analyzer/rule/rule.h"
#include "interp/geometry/direction.h"

#include <optional>

namespace ncvet {

/// Direction in the plane of the current block, a vector of length one, in which the cut before it
/// ends. Of plain blocks with absolute coordinates only; none after a rapid move.
std::optional<Vector> directionBefore(const RuleContext &ctx);

} // namespace ncvet
