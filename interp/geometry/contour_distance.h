// Least distances between straight lines and arcs of a plane.
#pragma once

#include "interp/geometry/contour_element.h"

namespace ncvet {

/// Sides parallel to the axes, mm.
struct Box {
  Vector low, high;
};

/// A box that holds the element; of an arc that of its full circle.
Box boxOf(const ContourElement &element);
/// Zero when they overlap.
double gapBetween(const Box &a, const Box &b);

/// Zero when they cross.
double distanceBetween(const ContourElement &a, const ContourElement &b);

} // namespace ncvet
