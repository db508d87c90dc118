// A rapid move in two axes leaves a bore.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class MotionRapidNotStraight final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().isLathe())
      return;
    to.onMoves({MotionKind::Rapid});
    depth_ = to.number("depth", 3);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    constexpr uint16_t both = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z);
    if (event.inMachineCoordinates() || event.axes != both)
      return;
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Interval &x = before.at(Axis::X), &z = before.at(Axis::Z), &to = after.at(Axis::X);
    if (before.may(Fact::AwayFromPart) || !x.isConstant() || !z.isConstant() || !to.isConstant() ||
        !(to.value() > x.value()) || !(z.value() <= -depth_))
      return;
    // On the centre line beyond the face the tool can only be a drill; else the tool list tells.
    const auto tool = ctx.machine().tools.find(before.tool);
    const llvm::StringRef kind =
        tool == ctx.machine().tools.end() ? llvm::StringRef() : llvm::StringRef(tool->second.kind);
    const bool inner = kind == "drill" || kind == "tap" || kind == "reamer" || kind == "boring" ||
                       (kind.empty() && x.value() == 0);
    if (!inner)
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "the axes do not arrive together: the path out of the bore is bent and crosses "
          "its wall");
  }

private:
  double depth_ = 3;
};

} // namespace
NCVET_RULE(MotionRapidNotStraight, motion_rapid_not_straight)
} // namespace ncvet
