// Compensation engages on the contour itself, or a contour is offset by hand.
#include "analyzer/rule/rule.h"
#include "interp/evaluate/tool_data.h"

#include <cmath>

namespace ncvet {
namespace {

struct CompensationSoftApproachAdvisedMemory {
  SourceRange first; ///< first move of a contour that seems to be offset by hand
  std::array<double, 3> corner{};
  unsigned sides = 0;
};

class CompensationSoftApproachAdvised final
    : public StatefulRule<CompensationSoftApproachAdvisedMemory> {
public:
  void listen(Subscriptions &to) override {
    const auto any = [&](auto wanted) { return llvm::any_of(to.dialect().codes, wanted); };
    pairs_ = any([](const CodeInfo &code) { return code.arrivesSoftly; });
    const bool soft =
        pairs_ || any([](const CodeInfo &code) { return code.action == Action::SoftApproach; });
    if (soft)
      to.onAction({Action::CompensationLeft, Action::CompensationRight});
    if (soft && !to.machine().tools.empty() && !to.dialect().isLathe())
      to.onMoves({MotionKind::Feed, MotionKind::Rapid, MotionKind::ArcCw, MotionKind::ArcCcw});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion)
      return byHand(event, ctx);
    if (ctx.code(event).arrivesSoftly || (pairs_ && !ctx.asked()))
      return;
    if (ctx.before().compensation != phaseOff || !axesOf(ctx.dialect(), ctx.block()))
      return;
    for (const CodeUse &use : ctx.codes())
      if (ctx.code(use).action == Action::SoftApproach)
        return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` meets the contour on a straight line: a soft approach leaves no mark "
                   "on the part",
                   ctx.code(event).name)
          .severity(pairs_ ? std::optional(Severity::Style) : std::nullopt);
  }

private:
  /// A closed contour of lines without compensation, of which every corner is the tool's radius
  /// away from round numbers.
  void byHand(const Event &event, RuleContext &ctx) const {
    constexpr unsigned fewest = 4; // sides that go round
    const std::optional<double> radius = radiusOf(ctx);
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    const uint16_t axes = event.axes & plane & 7u;
    if (!ctx.asked() || !radius || ctx.after().compensation != phaseOff ||
        (axes && event.motion != MotionKind::Feed)) {
      memory().sides = 0;
      return;
    }
    if (!axes)
      return;
    std::array<double, 3> corner{};
    for (unsigned i = 0; i < 3; ++i) {
      const Interval &from = ctx.before().position[i], &to = ctx.after().position[i];
      if (!(plane >> i & 1))
        continue;
      if (!to.isConstant() || (!(from == to) && !isOffset(to.value(), *radius))) {
        memory().sides = 0;
        return;
      }
      corner[i] = to.value();
    }
    if (memory().sides++ == 0) {
      memory().first = ctx.blockRange();
      memory().corner = corner;
      return;
    }
    if (memory().sides <= fewest || corner != memory().corner)
      return;
    memory().sides = 0;
    if (auto finding = ctx.report(memory().first))
      finding.severity(Severity::Style)
          .message("from here the tool goes round a contour that was offset by its radius {0} by "
                   "hand: with compensation another tool needs no other program",
                   *radius);
  }

  static std::optional<double> radiusOf(const RuleContext &ctx) {
    const ToolData *tool = toolInUse(ctx.machine(), ctx.after());
    return tool && tool->radius && *tool->radius > 0 ? tool->radius : std::nullopt;
  }

  static bool isOffset(double value, double radius) {
    const auto isRound = [](double number) {
      constexpr double round = 5, tolerance = 1e-6;
      return std::fabs(std::remainder(number, round)) < tolerance;
    };
    return !isRound(value) && (isRound(value + radius) || isRound(value - radius));
  }

  /// The same codes of compensation are there with an arc and without: advice for who asks for it.
  bool pairs_ = false;
};

} // namespace
NCVET_RULE(CompensationSoftApproachAdvised, compensation_soft_approach_advised)
} // namespace ncvet
