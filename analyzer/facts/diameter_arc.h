// An arc that closes when X is read as a diameter, where the control reads a radius.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// The distances of start and end from the centre if X counted as a diameter: half the way in X,
/// and the centre's distance as it is. None where X is one, or may be, or the arc has no X.
inline std::optional<std::pair<double, double>>
distancesAsDiameter(const ArcWords &words, const ArcGeometry &arc, const RuleContext &ctx) {
  const Dialect &dialect = ctx.dialect();
  const auto x = size_t(words.axes[0] == Axis::X ? 0 : 1);
  if (dialect.group(StandardGroup::Diameter) == noGroup || words.axes[x] != Axis::X ||
      !words.planeKnown || !arc.start || !arc.end || !arc.centreWords || arc.centreAbsolute ||
      words.axes[1 - x] != Axis::Z ||
      ctx.after().isActive(dialect, StandardGroup::Diameter,
                           {Action::DiameterOn, Action::DiameterAbsolute}) == Truth::Yes)
    return std::nullopt;
  Point way{(*arc.end)[0] - (*arc.start)[0], (*arc.end)[1] - (*arc.start)[1]};
  way[x] /= 2;
  const Point &centre = *arc.centreWords;
  return std::pair(distance(centre, Point(0, 0)), distance(centre, way));
}

} // namespace ncvet
