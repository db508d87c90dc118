// The words of an arc block: plane, centre, radius; and the geometry that they give.
#pragma once

#include "formats/dialect/machine.h"
#include "interp/geometry/arc.h"
#include "interp/state/event.h"

namespace ncvet {

/// The words of an arc block, sorted by what they mean in the active plane.
struct ArcWords {
  bool planeKnown = false;
  /// Axes of the plane in the order in which G02 turns from the second to the first: X Y, Z X, Y Z.
  std::array<Axis, 2> axes{Axis::X, Axis::Y};
  std::array<AddressId, 2> centreAddress{}; ///< I, J or K of each of these axes
  std::array<const Word *, 2> centre{};     ///< the block's centre words of the plane, or null
  const Word *foreign = nullptr;            ///< a centre word of the third axis
  const Word *radius = nullptr;             ///< R
  const Word *angle = nullptr;              ///< opening angle

  bool hasCentre() const { return centre[0] || centre[1]; }
};

/// Sorts the words of an arc block in the plane that `state` (after the block) has.
ArcWords arcWords(const Dialect &dialect, const MachineState &state, const Block &block);

/// Where the tool is along an axis in its plane, in millimetres, a diameter turned into a
/// radius. None where that is not known, as on a lathe whose program does not say which of both X
/// is.
std::optional<double> placeInPlane(const Dialect &dialect, const MachineState &state, Axis axis);

/// What centre words are where no code of the program says it.
enum class ArcCentres : uint8_t {
  Incremental, ///< distances from the start point
  Absolute,    ///< coordinates
  ByMode,      ///< as coordinates are: G90 or G91
  Unknown
};

/// As the machine is set, or usual for the control.
ArcCentres arcCentresOf(const Dialect &dialect, const MachineProfile &machine);

/// `centres`: see `arcCentresOf`.
ArcGeometry arcGeometry(const ArcWords &words, const Dialect &dialect,
                        const MachineProfile &machine, ArcCentres centres, const Block &block,
                        const MachineState &before, const MachineState &after);
inline ArcGeometry arcGeometry(const ArcWords &words, const Dialect &dialect,
                               const MachineProfile &machine, const Block &block,
                               const MachineState &before, const MachineState &after) {
  return arcGeometry(words, dialect, machine, arcCentresOf(dialect, machine), block, before, after);
}

} // namespace ncvet
