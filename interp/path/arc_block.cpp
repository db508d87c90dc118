// The words of an arc block: plane, centre, radius; and the geometry that they give.
#include "interp/path/arc_block.h"

#include "formats/dialect/control_facts.h"
#include "interp/evaluate/block_words.h"
#include "interp/state/modes.h"

#include <cmath>

namespace ncvet {

namespace {

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

namespace {

/// As `placeInPlane`; `lengths`: of the axis, see `Dialect::lengthsPerUnit`.
std::optional<double> placeOf(const Dialect &dialect, const MachineState &state, Axis axis,
                              double lengths) {
  const Interval &position = state.at(axis);
  if (!position.isConstant() || state.inMachineCoordinates(axis))
    return std::nullopt;
  // Nothing ever moved along Y and the plane is ZX: the machine is a lathe.
  if (axis == Axis::X && dialect.group(StandardGroup::Diameter) != noGroup &&
      state.active(dialect, StandardGroup::Diameter) & groupUnset &&
      state.isActive(dialect, StandardGroup::Plane, {Action::PlaneZX}) != Truth::No &&
      state.at(Axis::Y).isUnknown())
    return std::nullopt;
  return position.value() / lengths;
}

} // namespace

std::optional<double> placeInPlane(const Dialect &dialect, const MachineState &state, Axis axis) {
  return placeOf(dialect, state, axis, dialect.lengthsPerUnit(axis));
}

namespace {

/// Reads the words of one arc block.
class ArcReading {
public:
  ArcReading(const ArcWords &words, const Dialect &dialect, const MachineProfile &machine,
             ArcCentres centres, const Block &block, const MachineState &before,
             const MachineState &after)
      : words_(words), dialect_(dialect), machine_(machine), centres_(centres), block_(block),
        before_(before), after_(after) {}

  ArcGeometry run() {
    const std::array<double, 2> lengths{dialect_.lengthsPerUnit(words_.axes[0]),
                                        dialect_.lengthsPerUnit(words_.axes[1])};
    result_.start = point(before_, lengths);
    result_.end = point(after_, lengths);
    if (words_.radius)
      result_.radius = length(*words_.radius);
    if (result_.radius && asksForLargerArc(block_))
      result_.radius = -std::fabs(*result_.radius);
    if (words_.hasCentre())
      readCentre();
    applySettings();
    applyCodes();
    return result_;
  }

private:
  std::optional<Point> point(const MachineState &state,
                             const std::array<double, 2> &lengths) const {
    Point place = Point::Zero();
    for (size_t i = 0; i < 2; ++i) {
      const auto along = placeOf(dialect_, state, words_.axes[i], lengths[i]);
      if (!along)
        return std::nullopt;
      place[i] = *along;
    }
    return place;
  }

  std::optional<double> length(const Word &word) const {
    const Interval v = lengthOf(word, block_, dialect_, machine_, after_);
    if (!v.isConstant())
      return std::nullopt;
    return v.value();
  }

  void readCentre() {
    Point point = Point::Zero();
    bool known = true;
    for (size_t i = 0; i < 2; ++i)
      if (words_.centre[i]) {
        const auto v = length(*words_.centre[i]);
        known &= v.has_value();
        point[i] = v.value_or(0);
        if (words_.centre[i]->reading() == WordReading::Absolute) {
          known &= result_.start.has_value();
          const Interval share = shareOfDiameter(dialect_, after_, words_.axes[i], Truth::No);
          known &= share.isConstant();
          point[i] = point[i] * share.lo - (result_.start ? (*result_.start)[i] : 0);
        }
      }
    if (known && (!dialect_.facts->arcs.centreAndEnd || (words_.centre[0] && words_.centre[1])))
      result_.centreWords = point;
  }

  /// A control whose centres are coordinates, unless the machine was set otherwise.
  void applySettings() {
    if (centres_ == ArcCentres::Incremental)
      return;
    const Truth absolute =
        centres_ == ArcCentres::ByMode
            ? after_.isActive(dialect_, StandardGroup::Distance, {Action::Absolute})
        : centres_ == ArcCentres::Absolute ? Truth::Yes
                                           : Truth::Unknown;
    result_.centreAbsolute = absolute == Truth::Yes;
    if (absolute == Truth::Unknown)
      result_.centreWords.reset();
  }

  /// Codes of the program that say the same.
  void applyCodes() {
    if (dialect_.group(StandardGroup::ArcDistance) == noGroup ||
        after_.active(dialect_, StandardGroup::ArcDistance) == groupUnset)
      return;
    const Truth absolute =
        after_.isActive(dialect_, StandardGroup::ArcDistance, {Action::ArcAbsolute});
    result_.centreAbsolute = absolute == Truth::Yes;
    if (absolute == Truth::Unknown)
      result_.centreWords.reset();
  }

  const ArcWords &words_;
  const Dialect &dialect_;
  const MachineProfile &machine_;
  const ArcCentres centres_;
  const Block &block_;
  const MachineState &before_, &after_;
  ArcGeometry result_;
};

} // namespace

ArcCentres arcCentresOf(const Dialect &dialect, const MachineProfile &machine) {
  auto centres = machine.option("arcCentres");
  if (const auto usual = dialect.options.find("arcCentres");
      !centres && usual != dialect.options.end())
    centres = llvm::StringRef(usual->second);
  if (!centres || *centres == "incremental")
    return ArcCentres::Incremental;
  return *centres == "by-mode"    ? ArcCentres::ByMode
         : *centres == "absolute" ? ArcCentres::Absolute
                                  : ArcCentres::Unknown;
}

ArcGeometry arcGeometry(const ArcWords &words, const Dialect &dialect,
                        const MachineProfile &machine, ArcCentres centres, const Block &block,
                        const MachineState &before, const MachineState &after) {
  if (!words.planeKnown)
    return {};
  return ArcReading(words, dialect, machine, centres, block, before, after).run();
}

} // namespace ncvet
