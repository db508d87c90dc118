// End points by angle and radius: G16, and the words AP and RP about a pole.
#include "interp/execute/execution.h"

namespace ncvet {

PlanePlace Execution::inPlane() const {
  const auto [first, second] = planeOrder(dialect_, state_);
  PlanePlace place;
  if (!state_.inMachineCoordinates(first))
    place[0] = state_.at(first);
  if (!state_.inMachineCoordinates(second))
    place[1] = state_.at(second);
  return place;
}

void Execution::setInPlane(const PlanePlace &place) {
  const auto [first, second] = planeOrder(dialect_, state_);
  state_.at(first) = place[0];
  state_.at(second) = place[1];
  state_.machineAxes &= ~(1u << unsigned(first) | 1u << unsigned(second));
}

/// Whether the word counts from what was there before.
Truth Execution::countsFromBefore(const Word &word) const {
  const WordReading reading = word.reading();
  return dialect_.addresses[word.address].kind == AddressKind::Increment ||
                 word.has(wordIncremental) || reading == WordReading::Incremental
             ? Truth::Yes
         : reading != WordReading::Modal ? Truth::No
                                         : incremental();
}

/// G16: the words of the plane's axes are a radius and an angle about the zero point. `from` is the
/// place in the plane before the block.
void Execution::polarInput(const PlanePlace &from) {
  const auto [first, second] = planeOrder(dialect_, state_);
  bool along = false;
  for (const Word &word : block_.words) {
    if (!(dialect_.axisWords & maskOf(word.address)))
      continue;
    const Axis axis = dialect_.addresses[word.address].axis;
    if (axis != first && axis != second)
      continue;
    const Truth relative = countsFromBefore(word);
    Interval &kept = state_.polar[axis == first ? 0 : 1];
    if (axis == first) {
      kept = relative == Truth::Unknown ? Interval::unknown() : coordinate(word);
      along = relative == Truth::Yes;
    } else {
      kept = relative == Truth::Yes  ? kept + value(word)
             : relative == Truth::No ? value(word)
                                     : Interval::unknown();
    }
  }
  const PlanePlace zero{Interval::exactly(0), Interval::exactly(0)};
  setInPlane(placeAt(along ? from : zero, {state_.polar[0], state_.polar[1]}));
}

/// Words for angle and radius about the pole; what is left out is as it was before the block.
void Execution::polarTarget() {
  auto [radius, degrees] = polarOf(state_.pole, inPlane());
  for (const Word &word : block_.words) {
    const AddressInfo &address = dialect_.addresses[word.address];
    if (address.kind != AddressKind::Polar)
      continue;
    Interval &part = address.unit == AddressUnit::Angle ? degrees : radius;
    const Interval given = address.unit == AddressUnit::Angle ? value(word) : coordinate(word);
    const bool added = word.has(wordIncremental) || word.reading() == WordReading::Incremental;
    const Truth relative = dialect_.polarByDistance ? incremental() : Truth::No;
    part = added || relative == Truth::Yes ? part + given
           : relative == Truth::No         ? given
                                           : Interval::unknown();
  }
  if (block_.hasAny(dialect_.elementWords)) // a point of the contour's own geometry
    radius = Interval::unknown();
  setInPlane(placeAt(state_.pole, {radius, degrees}));
}

/// The pole itself: about the zero point, the present place, or the pole so far.
void Execution::setPole(Action reference) {
  state_.set(Fact::PoleSet);
  const PlanePlace zero{Interval::exactly(0), Interval::exactly(0)};
  const PlanePlace base = reference == Action::PoleFromPlace  ? inPlane()
                          : reference == Action::PoleFromPole ? state_.pole
                                                              : zero;
  const auto [first, second] = planeOrder(dialect_, state_);
  PlanePlace by = zero;
  Interval radius, degrees;
  for (const Word &word : block_.words) {
    const AddressInfo &address = dialect_.addresses[word.address];
    if (address.kind == AddressKind::Polar)
      (address.unit == AddressUnit::Angle ? degrees : radius) =
          address.unit == AddressUnit::Angle ? value(word) : coordinate(word);
    else if (dialect_.axisWords & maskOf(word.address) &&
             (address.axis == first || address.axis == second))
      by[address.axis == first ? 0 : 1] = coordinate(word);
  }
  if (block_.hasAny(dialect_.polarWords))
    by = placeAt(zero, {radius, degrees});
  for (size_t i = 0; i < 2; ++i)
    state_.pole[i] = base[i] + by[i];
}

} // namespace ncvet
