// Boxes that a tool may hit: stock and clamps of the machine profile.
#include "interp/geometry/obstacle.h"

#include <algorithm>

namespace ncvet {

namespace {

constexpr double tolerance = 1e-6; ///< mm: a path along a face does not lead through the box

/// The part of a path that lies between two bounds, from 0 at its start to 1 at its end.
struct Part {
  double begin = 0, end = 1;
};

Part between(double from, double to, double min, double max) {
  min += tolerance;
  max -= tolerance;
  if (from == to)
    return from > min && from < max ? Part() : Part{1, 0};
  const double a = (min - from) / (to - from), b = (max - from) / (to - from);
  return {std::max(0.0, std::min(a, b)), std::min(1.0, std::max(a, b))};
}

} // namespace

Truth leadsThrough(const Stock &box, const Place &from, const Place &to) {
  constexpr double far = 1e9; // mm: no bound
  Part inside;
  bool known = true;
  for (size_t i = 0; i < box.min.size(); ++i) {
    if (!box.min[i] && !box.max[i])
      continue;
    if (!from[i].isConstant() || !to[i].isConstant()) {
      known = false;
      continue;
    }
    const Part part = between(from[i].value(), to[i].value(), box.min[i].value_or(-far),
                              box.max[i].value_or(far));
    inside.begin = std::max(inside.begin, part.begin);
    inside.end = std::min(inside.end, part.end);
  }
  if (inside.begin > inside.end)
    return Truth::No;
  return known ? Truth::Yes : Truth::Unknown;
}

} // namespace ncvet
