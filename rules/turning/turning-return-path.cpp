// The return to the start point at the end of a cycle can cross the part.
#include "analyzer/facts/turning_profile.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/number_text.h"

#include <cmath>

namespace ncvet {
namespace {

constexpr double pathTolerance = 1e-4; // mm

class TurningReturnPath final : public Rule {
public:
  void listen(Subscriptions &to) override {
    together_ = to.flag("together");
    if (together_ || to.dialect().facts->turning.returnsByAxes)
      to.on(EventKind::CycleRun);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.outcome().flow.kind != FlowKind::Profile)
      return;
    const CodeInfo &cycle = ctx.code(event);
    const Profile profile = readProfile(ctx);
    const Interval &startX = ctx.after().at(Axis::X), &startZ = ctx.after().at(Axis::Z);
    if (!profile.known || !profile.minX || !profile.minZ || !startX.isConstant() ||
        !startZ.isConstant() || ctx.after().inMachineCoordinates(Axis::X) ||
        ctx.after().inMachineCoordinates(Axis::Z))
      return;
    const ProfileBlock &end = profile.blocks.back();
    if (!end.toX.isConstant() || !end.toZ.isConstant())
      return;
    const size_t first = firstOfContour(profile);
    // Whether the contour opens towards the axis or away from it; the start says nothing here.
    const double rise =
        profile.blocks[profile.lastCut - 1].toX.value() - profile.blocks[first].toX.value();
    if (rise > -pathTolerance && rise < pathTolerance)
      return;
    // From the axis a contour that narrows is one of a bore.
    const bool inside =
        rise < 0 && (profile.side != Side::Outside ||
                     startX.value() < profile.blocks[profile.lastCut - 1].toX.value());
    const double x = end.toX.value(), z = end.toZ.value();
    if (together_)
      return returnsTogether(event, profile, {z, x}, {startZ.value(), startX.value()}, inside, ctx);
    const bool zFirst = startX.value() < x;
    bool crosses = false;
    if (zFirst) {
      // Along Z at the last block's diameter, and then along X to the start: through every part of
      // the contour in between.
      for (size_t i = first; i < profile.lastCut; ++i) {
        const ProfileBlock &block = profile.blocks[i];
        if (!block.moves || !block.toZ.isConstant())
          continue;
        const double cz = block.toZ.value(), cx = block.toX.value();
        const bool onWay = cz > std::min(z, startZ.value()) + pathTolerance &&
                           cz < std::max(z, startZ.value()) - pathTolerance;
        crosses |= onWay && (inside ? cx < x - pathTolerance : cx > x + pathTolerance);
      }
      crosses |= !inside && isInside(profile, startX.value(), startZ.value());
    } else {
      // Along X where the last block ends: through the wall of a bore.
      const double wall = profile.blocks[profile.lastCut - 1].toX.value();
      const bool pastFace = z < *profile.maxZ - pathTolerance;
      crosses = inside && pastFace && startX.value() > wall + pathTolerance;
    }
    if (!crosses)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("after its last block `{0}` returns {1} first, from X{2} Z{3} to X{4} Z{5}: "
                   "that path "
                   "crosses the part",
                   cycle.name, zFirst ? "in Z" : "in X", text(x, ctx), text(z, ctx),
                   text(startX.value(), ctx), text(startZ.value(), ctx))
          .note(end.range, "the last block of the profile");
  }

private:
  /// The block that leads to the begin of the contour: the way to it may be several rapid moves.
  static size_t firstOfContour(const Profile &profile) {
    size_t first = 0;
    for (size_t i = 0; i < profile.lastCut; ++i) {
      const ProfileBlock &block = profile.blocks[i];
      if (block.moves && block.motion != MotionKind::Rapid)
        break;
      if (block.moves && block.toX.isConstant())
        first = i;
    }
    return first;
  }

  bool together_ = false; ///< both axes go back at once, at their own speeds

  /// Reported only where both ways on which the tool may go back lead through the part: straight,
  /// and with the axes at the same speed until the shorter way is done. Places are Z and X.
  static void returnsTogether(const Event &event, const Profile &profile, const Point &from,
                              const Point &to, bool inside, RuleContext &ctx) {
    const double perLength = ctx.dialect().lengthsPerUnit(Axis::X);
    const Vector way(to.x() - from.x(), (to.y() - from.y()) / perLength);
    const double both = std::min(std::fabs(way.x()), std::fabs(way.y()));
    const Point corner(from.x() + std::copysign(both, way.x()),
                       from.y() + std::copysign(both, way.y()) * perLength);
    if (!crosses(profile, {from, to}, inside) || !crosses(profile, {from, corner, to}, inside))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("after its last block `{0}` returns from X{1} Z{2} to X{3} Z{4} with both axes "
                   "at once: that path crosses the part",
                   ctx.code(event).name, text(from.y(), ctx), text(from.x(), ctx),
                   text(to.y(), ctx), text(to.x(), ctx))
          .note(profile.blocks.back().range, "the last block of the profile");
  }

  /// Whether a way of straight lines passes a corner of the contour on the part's side.
  static bool crosses(const Profile &profile, llvm::ArrayRef<Point> way, bool inside) {
    for (size_t leg = 1; leg < way.size(); ++leg) {
      const Point &from = way[leg - 1], &to = way[leg];
      const double length = to.x() - from.x();
      if (std::fabs(length) <= pathTolerance)
        continue;
      for (size_t i = 0; i < profile.lastCut; ++i) {
        const ProfileBlock &block = profile.blocks[i];
        if (!block.moves || !block.toX.isConstant() || !block.toZ.isConstant())
          continue;
        const double part = (block.toZ.value() - from.x()) / length;
        if (part <= 0 || part >= 1)
          continue;
        const double x = from.y() + part * (to.y() - from.y());
        if (inside ? x > block.toX.value() + pathTolerance : x < block.toX.value() - pathTolerance)
          return true;
      }
    }
    return false;
  }

  /// Whether the place lies in what an outside contour leaves uncut: below both ends of an
  /// element that passes by it.
  static bool isInside(const Profile &profile, double x, double z) {
    for (size_t i = 1; i < profile.lastCut; ++i) {
      const ProfileBlock &block = profile.blocks[i];
      if (!block.moves || !block.fromX.isConstant() || !block.fromZ.isConstant() ||
          !block.toX.isConstant() || !block.toZ.isConstant())
        continue;
      const double from = block.fromZ.value(), to = block.toZ.value();
      if (z > std::min(from, to) + pathTolerance && z < std::max(from, to) - pathTolerance &&
          x < std::min(block.fromX.value(), block.toX.value()) - pathTolerance)
        return true;
    }
    return false;
  }

  static std::string text(double value, RuleContext &ctx) {
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    return shortNumber(value / unit.value_or(1));
  }
};

} // namespace
NCVET_RULE(TurningReturnPath, turning_return_path)
} // namespace ncvet
