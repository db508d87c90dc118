// The geometry of an arc: start, end, centre, radius.
#include "interp/geometry/arc.h"

namespace ncvet {

std::optional<Point> ArcGeometry::centre() const {
  if (!centreWords)
    return std::nullopt;
  if (centreAbsolute)
    return centreWords;
  if (!start)
    return std::nullopt;
  return Point(*start + *centreWords);
}

} // namespace ncvet
