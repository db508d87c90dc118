// Rapid moves of a lathe towards the chuck that the text of its program shows to be slips.
#pragma once

#include "analyzer/facts/places_along.h"
#include "analyzer/facts/turned_shape.h"

namespace ncvet {

struct RapidSlip {
  const char *what; ///< a message, with a length
  double length;    ///< mm
};

/// Into the face that was just cut to the axis, on the axis where nothing is drilled yet, or with a
/// feed in its block as no other rapid move.
std::optional<RapidSlip> rapidToChuck(const TurnedShapes &shapes, const PlacesOfPrograms &places,
                                      const Event &event, const RuleContext &ctx);

} // namespace ncvet
