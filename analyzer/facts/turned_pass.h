// The pass along the work that a lathe has just turned, as its blocks say it.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// A cylinder that was cut towards the chuck, and left outward at rapid, or inward by a feed move.
struct TurnedPass {
  double diameter, begin, end; ///< X, and Z from right to left, as written
  double away;                 ///< X of the way out
  SourceRange range;           ///< the cut
};

/// The pass before the current block: X and Z of the approach, a feed along Z alone, and a rapid
/// move away from the axis, or a feed move into the material. None where the blocks say anything
/// else.
std::optional<TurnedPass> turnedBefore(const RuleContext &ctx);

/// Such a pass, and the Z at which a move comes to its diameter.
struct CrossedPass {
  TurnedPass pass;
  double at;
  const char *what; ///< a message, with the diameter and that Z
};

/// Whether the rapid move of `event` leads from the end of the pass before it, in X and Z at once,
/// through what was just turned, or through what is left inside of it.
std::optional<CrossedPass> crossedPass(const Event &event, const RuleContext &ctx);

/// The next move leads away from the work in X, at rapid.
bool retractsNext(const RuleContext &ctx);

/// At least two other blocks of the program lead to this X and the Z with the other sign, and none
/// to this one.
bool mirrorsOthers(const RuleContext &ctx, double x, double z);

/// Whether a control for mills and lathes is on a lathe: its plane and feed say so.
bool isTurning(const RuleContext &ctx);

} // namespace ncvet
