// The pass along the work that a lathe has just turned, as its blocks say it.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// A cylinder that was cut towards the chuck, and left outward at rapid.
struct TurnedPass {
  double diameter, begin, end; ///< X, and Z from right to left, as written
  double away;                 ///< X of the retract
  SourceRange range;           ///< the cut
};

/// The pass before the current block: X and Z of the approach, a feed along Z alone, and a rapid
/// move away from the axis. None where the blocks say anything else.
std::optional<TurnedPass> turnedBefore(const RuleContext &ctx);

/// Such a pass, and the Z at which a move comes to its diameter.
struct CrossedPass {
  TurnedPass pass;
  double at;
};

/// Whether the rapid move of `event` leads from the end of the pass before it, in X and Z at once,
/// through what was just turned.
std::optional<CrossedPass> crossedPass(const Event &event, const RuleContext &ctx);

/// Whether a control for mills and lathes is on a lathe: its plane and feed say so.
bool isTurning(const RuleContext &ctx);

} // namespace ncvet
