// Whether the contour of a turning profile rises or falls steadily.
#pragma once

#include "analyzer/facts/turning_profile.h"

namespace ncvet {

/// Where a contour turns back along one axis.
struct ShapeBreak {
  bool decided = false; ///< all end points are known
  bool found = false;
  size_t index = 0;     ///< block that turns back
  unsigned pockets = 0; ///< how often it turns into a pocket
};

/// Where the contour's X turns back by more than `least` (mm), so that a pocket forms: from one
/// block's end to the next, or inside of an arc.
ShapeBreak undercutOf(const RuleContext &ctx, const Profile &profile, double least = 1e-4);
/// Where Z turns back.
ShapeBreak returnInZ(const RuleContext &ctx, const Profile &profile, double least = 1e-4);

} // namespace ncvet
