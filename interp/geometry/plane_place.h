// Places in a plane of which the coordinates may not be known, and turns of them.
#pragma once

#include "interp/value/value.h"

#include <array>

namespace ncvet {

/// Along the first and the second axis of a plane.
using PlanePlace = std::array<Interval, 2>;

/// A place by its distance from a pole and its angle.
struct PolarPlace {
  Interval radius;
  Interval degrees; ///< from the first axis, counter-clockwise
};

/// The place at that radius and angle about `pole`; not known where one of the two is not.
PlanePlace placeAt(const PlanePlace &pole, const PolarPlace &polar);

/// Radius and angle of a place about `pole`; not known where a coordinate is not.
PolarPlace polarOf(const PlanePlace &pole, const PlanePlace &place);

/// Turned about the zero point, counter-clockwise.
PlanePlace turnedPlace(const PlanePlace &place, double degrees);

/// How far a line at that angle goes along one axis for each millimetre along the other: along the
/// first one, or along the second one. Infinite where it goes along that axis alone.
double slopeOf(double degrees, bool alongFirst);

} // namespace ncvet
