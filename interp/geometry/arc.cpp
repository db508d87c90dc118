// The words and the geometry of an arc block: plane, centre, radius, start and end.
#include "interp/geometry/arc.h"

#include "interp/execute/execute.h"

#include <cmath>

namespace ncvet {

namespace {
/// Ends of a circle that are closer than this (mm) are one point.
constexpr double closeBy = 1e-6;

/// A K without a number selects the arc over 180 degrees, where a control has such a flag.
bool asksForLargerArc(const Block &block) {
  const Word *flag = block.find('K');
  return flag && flag->has(wordNoValue);
}
} // namespace

ArcWords arcWords(const Dialect &dialect, const MachineState &state, const Block &block) {
  ArcWords result;
  const Action plane = state.activeAction(dialect, StandardGroup::Plane);
  const uint64_t set = state.active(dialect, StandardGroup::Plane);
  result.planeKnown = plane != Action::None || set == groupUnset;
  result.axes = planeOrder(dialect, state);
  for (unsigned axis = 0; axis < 3; ++axis) {
    const auto address = AddressId(letterAddress('I') + axis);
    const Word *word = block.find(address);
    if (result.axes[0] == Axis(axis)) {
      result.centreAddress[0] = address;
      result.centre[0] = word;
    } else if (result.axes[1] == Axis(axis)) {
      result.centreAddress[1] = address;
      result.centre[1] = word;
    } else if (!word || !word->has(wordNoValue)) { // without a number it is a flag
      result.foreign = word;
    }
  }
  result.radius = block.find(dialect.arcRadius);
  result.angle = dialect.arcAngle == noAddress ? nullptr : block.find(dialect.arcAngle);
  return result;
}

std::optional<ArcGeometry::Point> ArcGeometry::centre() const {
  if (!centreWords)
    return std::nullopt;
  if (centreAbsolute)
    return centreWords;
  if (!start)
    return std::nullopt;
  return Point{(*start)[0] + (*centreWords)[0], (*start)[1] + (*centreWords)[1]};
}

std::optional<double> placeInPlane(const Dialect &dialect, const MachineState &state, Axis axis) {
  const Interval &position = state.at(axis);
  if (!position.isConstant() || state.inMachineCoordinates(axis))
    return std::nullopt;
  // Nothing ever moved along Y and the plane is ZX: the machine is a lathe.
  if (axis == Axis::X && dialect.group(StandardGroup::Diameter) != noGroup &&
      state.active(dialect, StandardGroup::Diameter) & groupUnset &&
      state.isActive(dialect, StandardGroup::Plane, {Action::PlaneZX}) != Truth::No &&
      state.at(Axis::Y).isUnknown())
    return std::nullopt;
  return position.value() / dialect.lengthsPerUnit(axis);
}

ArcGeometry arcGeometry(const ArcWords &words, const Dialect &dialect,
                        const MachineProfile &machine, const Block &block,
                        const MachineState &before, const MachineState &after) {
  ArcGeometry result;
  if (!words.planeKnown)
    return result;
  const auto place = [&](const MachineState &state) -> std::optional<ArcGeometry::Point> {
    ArcGeometry::Point point{};
    for (size_t i = 0; i < 2; ++i) {
      const auto along = placeInPlane(dialect, state, words.axes[i]);
      if (!along)
        return std::nullopt;
      point[i] = *along;
    }
    return point;
  };
  result.start = place(before);
  result.end = place(after);
  const auto length = [&](const Word &word) -> std::optional<double> {
    const Interval v = lengthOf(word, block, dialect, machine, after);
    if (!v.isConstant())
      return std::nullopt;
    return v.value();
  };
  if (words.radius)
    result.radius = length(*words.radius);
  if (result.radius && asksForLargerArc(block))
    result.radius = -std::fabs(*result.radius);
  if (words.hasCentre()) {
    ArcGeometry::Point point{};
    bool known = true;
    for (size_t i = 0; i < 2; ++i)
      if (words.centre[i]) {
        const auto v = length(*words.centre[i]);
        known &= v.has_value();
        point[i] = v.value_or(0);
        if (words.centre[i]->reading() == WordReading::Absolute) {
          known &= result.start.has_value();
          const Interval share = shareOfDiameter(dialect, after, words.axes[i], Truth::No);
          known &= share.isConstant();
          point[i] = point[i] * share.lo - (result.start ? (*result.start)[i] : 0);
        }
      }
    if (known)
      result.centreWords = point;
  }
  // A control whose centres are coordinates, unless the machine was set otherwise.
  auto centres = machine.option("arcCentres");
  if (const auto usual = dialect.options.find("arcCentres");
      !centres && usual != dialect.options.end())
    centres = llvm::StringRef(usual->second);
  if (centres && *centres != "incremental") {
    result.centreAbsolute = *centres == "absolute";
    if (!result.centreAbsolute)
      result.centreWords.reset();
  }
  if (dialect.group(StandardGroup::ArcDistance) != noGroup &&
      after.active(dialect, StandardGroup::ArcDistance) != groupUnset) {
    const Truth absolute =
        after.isActive(dialect, StandardGroup::ArcDistance, {Action::ArcAbsolute});
    result.centreAbsolute = absolute == Truth::Yes;
    if (absolute == Truth::Unknown)
      result.centreWords.reset();
  }
  return result;
}

std::optional<ArcGeometry::Point> centreByRadius(const ArcGeometry::Point &start,
                                                 const ArcGeometry::Point &end, double radius,
                                                 bool clockwise) {
  const double dx = end[0] - start[0], dy = end[1] - start[1];
  const double chord = std::hypot(dx, dy);
  if (chord < closeBy)
    return std::nullopt;
  double square = radius * radius - chord * chord / 4;
  if (square < 0) {
    if (square < -closeBy * std::fabs(radius) - closeBy)
      return std::nullopt;
    square = 0;
  }
  const double side = (clockwise ? -1 : 1) * (radius < 0 ? -1 : 1) * std::sqrt(square) / chord;
  return ArcGeometry::Point{start[0] + dx / 2 - dy * side, start[1] + dy / 2 + dx * side};
}

} // namespace ncvet
