// Places in a plane of which the coordinates may not be known, and turns of them.
#include "interp/geometry/plane_place.h"

#include "interp/geometry/direction.h"

namespace ncvet {

PlanePlace placeAt(const PlanePlace &pole, const PolarPlace &polar) {
  if (!polar.radius.isConstant() || !polar.degrees.isConstant())
    return {};
  const Vector way = polar.radius.value() * unitVector(radiansOf(polar.degrees.value()));
  return {pole[0] + Interval::exactly(way.x()), pole[1] + Interval::exactly(way.y())};
}

PolarPlace polarOf(const PlanePlace &pole, const PlanePlace &place) {
  if (!place[0].isConstant() || !place[1].isConstant() || !pole[0].isConstant() ||
      !pole[1].isConstant())
    return {};
  const Point from{pole[0].value(), pole[1].value()}, to{place[0].value(), place[1].value()};
  return {Interval::exactly(distance(from, to)), Interval::exactly(degreesOf(angleOf(to - from)))};
}

PlanePlace turnedPlace(const PlanePlace &place, double degrees) {
  if (place[0].isUnknown() || place[1].isUnknown())
    return {};
  const Vector direction = unitVector(radiansOf(degrees));
  return {place[0] * direction.x() - place[1] * direction.y(),
          place[0] * direction.y() + place[1] * direction.x()};
}

double slopeOf(double degrees, bool alongFirst) {
  const Vector direction = unitVector(radiansOf(degrees));
  return alongFirst ? direction.x() / direction.y() : direction.y() / direction.x();
}

} // namespace ncvet
