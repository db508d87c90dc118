// Whether the contour of a turning profile rises or falls steadily.
#include "analyzer/facts/profile_shape.h"

#include "interp/geometry/circle.h"

namespace ncvet {

namespace {

/// By how much (mm) an arc leads beyond both of its ends before that is more than rounding: the
/// centre of an arc that runs out along an axis is rarely met to the last digit.
constexpr double leastBulge = 0.02;

/// Number of an address, in millimetres; none when it is absent or not known here.
std::optional<double> lengthOf(const Block &block, char letter, double unit) {
  const Word *word = block.find(letter);
  if (!word || !word->isNumber())
    return std::nullopt;
  return word->value() * unit;
}

/// Where along `axis` an arc of the profile turns back between its ends, in the order of the path;
/// X as programmed.
llvm::SmallVector<double, 2> turnsOf(const RuleContext &ctx, const ProfileBlock &block, Axis axis) {
  llvm::SmallVector<double, 2> turns;
  const bool clockwise = block.motion == MotionKind::ArcCw;
  const auto unit = millimetresPer(ctx.dialect(), ctx.after());
  if ((!clockwise && block.motion != MotionKind::ArcCcw) || !block.motionKnown || !unit ||
      !block.fromX.isConstant() || !block.fromZ.isConstant() || !block.toX.isConstant() ||
      !block.toZ.isConstant())
    return turns;
  const double perX = ctx.dialect().lengthsPerUnit(Axis::X);
  const Point start{block.fromZ.value(), block.fromX.value() / perX};
  const Point end{block.toZ.value(), block.toX.value() / perX};
  std::optional<Point> centre;
  if (const auto radius = lengthOf(block.block, 'R', *unit)) {
    centre = centreByRadius(start, end, *radius, clockwise);
  } else if (block.block.hasAny(lettersMask("IK"))) {
    const auto i = lengthOf(block.block, 'I', *unit);
    const auto k = lengthOf(block.block, 'K', *unit);
    if ((i || !block.block.has(letterAddress('I'))) && (k || !block.block.has(letterAddress('K'))))
      centre = Point{start[0] + k.value_or(0), start[1] + i.value_or(0)};
  }
  if (!centre)
    return turns;
  const double radius = distance(*centre, start);
  constexpr double fits = 0.02; // mm; words that make no circle are another rule's business
  if (std::fabs(distance(*centre, end) - radius) > fits)
    return turns;
  const double begin = angleOf(start - *centre);
  const double whole = turnBetween(begin, angleOf(end - *centre), clockwise);
  const size_t along = axis == Axis::Z ? 0 : 1;
  const double low = std::min(start[along], end[along]), high = std::max(start[along], end[along]);
  llvm::SmallVector<std::pair<double, double>, 2> found; // way, place
  for (const double sign : {1.0, -1.0}) {
    const double place = (*centre)[along] + sign * radius;
    const double outermost = along ? sign * quarterTurn : sign > 0 ? 0 : halfTurn;
    const double way = turnBetween(begin, outermost, clockwise);
    if (way < whole && (place > high + leastBulge || place < low - leastBulge))
      found.push_back({way, place * (along ? perX : 1)});
  }
  llvm::sort(found);
  for (const auto &[way, place] : found)
    turns.push_back(place);
  return turns;
}

ShapeBreak turnsBack(const RuleContext &ctx, const Profile &profile, Axis axis, int expected,
                     double least) {
  ShapeBreak result;
  if (!profile.known)
    return result;
  const auto from = axis == Axis::X ? &ProfileBlock::fromX : &ProfileBlock::fromZ;
  const auto to = axis == Axis::X ? &ProfileBlock::toX : &ProfileBlock::toZ;
  int direction = expected, previous = expected;
  bool begun = false; // the first move leads to the contour
  for (size_t i = 0; i < profile.lastCut; ++i) {
    const ProfileBlock &block = profile.blocks[i];
    if (!block.moves)
      continue;
    if (!begun) {
      begun = true;
      continue;
    }
    const Interval &a = block.*from, &b = block.*to;
    if (!a.isConstant() || !b.isConstant())
      return result;
    llvm::SmallVector<double, 4> places{a.value()};
    places.append(turnsOf(ctx, block, axis));
    places.push_back(b.value());
    for (size_t j = 1; j < places.size(); ++j) {
      const double way = places[j] - places[j - 1];
      if (way > -least && way < least)
        continue;
      const int sign = way > 0 ? 1 : -1;
      if (direction == 0)
        direction = sign;
      if (sign != direction) {
        if (!result.found) {
          result.found = true;
          result.index = i;
        }
        if (previous != sign)
          ++result.pockets;
      }
      previous = sign;
    }
  }
  result.decided = true;
  return result;
}

} // namespace

ShapeBreak undercutOf(const RuleContext &ctx, const Profile &profile, double least) {
  const int expected = profile.side == Side::Outside ? 1 : profile.side == Side::Inside ? -1 : 0;
  return turnsBack(ctx, profile, Axis::X, expected, least);
}

ShapeBreak returnInZ(const RuleContext &ctx, const Profile &profile, double least) {
  return turnsBack(ctx, profile, Axis::Z, 0, least);
}

} // namespace ncvet
