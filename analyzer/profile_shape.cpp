// Whether the contour of a turning profile rises or falls steadily.
#include "analyzer/profile_shape.h"

namespace ncvet {

namespace {

ShapeBreak turnsBack(const Profile &profile, Interval ProfileBlock::*from,
                     Interval ProfileBlock::*to, int expected, double least) {
  ShapeBreak result;
  if (!profile.known)
    return result;
  int direction = expected, previous = expected;
  for (size_t i = 1; i < profile.lastCut; ++i) {
    const ProfileBlock &block = profile.blocks[i];
    if (!block.moves)
      continue;
    const Interval &a = block.*from, &b = block.*to;
    if (!a.isConstant() || !b.isConstant())
      return result;
    const double way = b.value() - a.value();
    if (way > -least && way < least)
      continue;
    const int sign = way > 0 ? 1 : -1;
    if (direction == 0)
      direction = sign;
    if (sign != direction) {
      if (!result.found) {
        result.found = true;
        result.index = i;
      }
      if (previous != sign)
        ++result.pockets;
    }
    previous = sign;
  }
  result.decided = true;
  return result;
}

} // namespace

ShapeBreak undercutOf(const Profile &profile, double least) {
  const int expected = profile.side == Side::Outside ? 1 : profile.side == Side::Inside ? -1 : 0;
  return turnsBack(profile, &ProfileBlock::fromX, &ProfileBlock::toX, expected, least);
}

ShapeBreak returnInZ(const Profile &profile, double least) {
  return turnsBack(profile, &ProfileBlock::fromZ, &ProfileBlock::toZ, 0, least);
}

} // namespace ncvet
