// A rapid move in two axes at once, whose bent path crosses the part.
#include "analyzer/facts/turned_shape.h"

#include <algorithm>
#include <vector>

namespace ncvet {
namespace {

class MotionRapidNotStraight final : public Rule {
public:
  void listen(Subscriptions &to) override {
    lathe_ = to.dialect().isLathe();
    if (!lathe_ && to.dialect().group(StandardGroup::Diameter) == noGroup)
      return;
    to.onMoves({MotionKind::Rapid});
    depth_ = to.number("depth", 3);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    constexpr uint16_t both = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
    if (event.inMachineCoordinates() || event.axes != both)
      return;
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Interval &x = before.at(Axis::X), &z = before.at(Axis::Z);
    const Interval &toX = after.at(Axis::X), &toZ = after.at(Axis::Z);
    if (!x.isConstant() || !z.isConstant() || !toX.isConstant() ||
        before.inMachineCoordinates(Axis::X) || before.inMachineCoordinates(Axis::Z))
      return;
    if (outOfGroove(event, ctx) || !lathe_)
      return;
    if (toX.value() > x.value()) {
      outOfBore(event, ctx);
    } else if (toX.value() < x.value() && toZ.isConstant()) {
      if (toZ.value() < z.value())
        intoBore(event, ctx);
      else if (toZ.value() > z.value())
        overShoulder(event, ctx);
    }
  }

private:
  bool outOfGroove(const Event &event, RuleContext &ctx) const {
    if (!event.certain || ctx.before().profile != ProfileMode::Off ||
        ctx.before().is(Fact::AwayFromPart) != Truth::No || !rapidOutOfGroove(shapes_, ctx))
      return false;
    if (auto finding = ctx.report(event))
      finding.message("both axes go at rapid from the bottom of a groove: the tool goes through "
                      "its wall before it is out");
    return true;
  }

  void outOfBore(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    if (before.may(Fact::AwayFromPart) || !(before.at(Axis::Z).value() <= -depth_))
      return;
    // On the centre line beyond the face the tool can only be a drill; else the tool list tells.
    const llvm::StringRef kind = toolKind(ctx);
    if (!worksInside(kind) &&
        !(kind.empty() && before.at(Axis::X).value() == 0 && !isCutToCentre(ctx)))
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "the axes do not arrive together: the path out of the bore is bent and crosses "
          "its wall");
  }

  /// The last move led to the centre line: a tool that faces or parts off is there, not a drill.
  static bool isCutToCentre(const RuleContext &ctx) {
    constexpr unsigned furthest = 10; // blocks
    const Dialect &dialect = ctx.dialect();
    const AddressMask axes = dialect.axisWords | dialect.incrementWords;
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < furthest; ++i, more = readBack(ctx, block))
      if (block.hasAny(axes))
        return (axesOf(dialect, block) >> unsigned(Axis::X) & 1) &&
               !findCode(dialect, block, {Action::Cycle, Action::Rapid});
    return false;
  }

  void intoBore(const Event &event, RuleContext &ctx) const {
    if (!(ctx.after().at(Axis::Z).value() <= -depth_) || !(ctx.before().at(Axis::Z).value() > 0) ||
        !worksInside(toolKind(ctx)))
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "the axes do not arrive together: the path into the bore is bent and crosses its wall");
  }

  /// Back before the part in both axes at once, from the end of a contour that was turned.
  static void overShoulder(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const auto unit = millimetresPer(ctx.dialect(), before);
    const std::vector<Place> contour = turnedBefore(ctx);
    if (!unit || before.may(Fact::AwayFromPart) || !isOutside(contour))
      return;
    const Place from{before.at(Axis::X).value() / *unit, before.at(Axis::Z).value() / *unit},
        to{after.at(Axis::X).value() / *unit, after.at(Axis::Z).value() / *unit};
    // Both axes run at the same speed until one of them is there. X is a diameter.
    const double way = std::min((from.x - to.x) / 2, to.z - from.z);
    const Place bend{from.x - 2 * way, from.z + way};
    const std::vector<Place> path{from, bend, to};
    constexpr double least = 0.01;
    const auto crosses = [&](double z) {
      const auto tool = diameterAt(path, z), part = diameterAt(contour, z);
      // Before the face, at Z0, there is nothing to meet.
      return z < 0 && z > from.z + least && tool && part && *tool < *part - least;
    };
    if (!crosses(bend.z) && llvm::none_of(contour, [&](const Place &p) { return crosses(p.z); }))
      return;
    if (auto finding = ctx.report(event, false))
      finding.message("the axes do not arrive together: the path back is bent and crosses the "
                      "shoulder that was turned before it");
  }

  /// A point in units of the program, X as a diameter.
  struct Place {
    double x, z;
  };

  /// Two shoulders that grow towards the chuck, and nothing that falls: a bore has none of them.
  static bool isOutside(const std::vector<Place> &contour) {
    unsigned shoulders = 0;
    bool grew = false;
    for (size_t i = 1; i < contour.size(); ++i) {
      const Place &from = contour[i - 1], &to = contour[i];
      if (to.x < from.x || to.z > from.z)
        return false;
      shoulders += to.x > from.x && !grew;
      grew = to.x > from.x;
    }
    return shoulders >= 2;
  }

  /// The greatest X of the line at a Z; none where it is not.
  static std::optional<double> diameterAt(const std::vector<Place> &line, double z) {
    std::optional<double> greatest;
    for (size_t i = 1; i < line.size(); ++i) {
      const Place &a = line[i - 1], &b = line[i];
      if (z < std::min(a.z, b.z) || z > std::max(a.z, b.z))
        continue;
      const double x =
          a.z == b.z ? std::max(a.x, b.x) : a.x + (b.x - a.x) * (z - a.z) / (b.z - a.z);
      greatest = std::max(greatest.value_or(x), x);
    }
    return greatest;
  }

  /// The lines that were cut since the last rapid move, as the text has them. Empty where anything
  /// else is between.
  static std::vector<Place> turnedBefore(const RuleContext &ctx) {
    constexpr unsigned furthest = 40; // blocks
    const Dialect &dialect = ctx.dialect();
    std::vector<std::pair<std::optional<double>, std::optional<double>>>
        words; // the last one first
    Block block;
    bool rapid = false;
    for (unsigned i = 0; i < furthest && !rapid; ++i) {
      const bool more = i == 0 ? readPrevious(ctx, block) : readBack(ctx, block);
      if (!more || !block.items.empty() || block.skip >= 0 || block.hasAny(dialect.incrementWords))
        return {};
      rapid = findCode(dialect, block, {Action::Rapid});
      if (!rapid && hasMotionCode(dialect, block) && !findCode(dialect, block, {Action::Linear}))
        return {};
      if (!block.hasAny(dialect.axisWords))
        continue;
      if (findCode(dialect, block, {Action::MachineMove, Action::ReferenceReturn}))
        return {};
      const Word *x = block.find('X'), *z = block.find('Z');
      if ((x && (!x->isNumber() || x->has(wordIncremental))) ||
          (z && (!z->isNumber() || z->has(wordIncremental))))
        return {};
      words.emplace_back(x ? std::optional(x->value()) : std::nullopt,
                         z ? std::optional(z->value()) : std::nullopt);
    }
    std::vector<Place> contour;
    std::optional<double> x, z;
    for (const auto &[newX, newZ] : llvm::reverse(words)) {
      x = newX ? newX : x;
      z = newZ ? newZ : z;
      if (x && z)
        contour.push_back({*x, *z});
    }
    return rapid ? contour : std::vector<Place>();
  }

  static llvm::StringRef toolKind(const RuleContext &ctx) {
    const auto tool = ctx.machine().tools.find(ctx.before().tool);
    return tool == ctx.machine().tools.end() ? llvm::StringRef()
                                             : llvm::StringRef(tool->second.kind);
  }
  static bool worksInside(llvm::StringRef kind) {
    return kind == "drill" || kind == "tap" || kind == "reamer" || kind == "boring";
  }

  TurnedShapes shapes_;
  bool lathe_ = false;
  double depth_ = 3;
};

} // namespace
NCVET_RULE(MotionRapidNotStraight, motion_rapid_not_straight)
} // namespace ncvet
