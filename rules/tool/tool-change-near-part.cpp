// A tool change where the tool stands in the work or too low.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ToolChangeNearPart final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::ToolChange); }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &before = ctx.before();
    if (before.profile != 0)
      return;
    if (const auto lowest = ctx.machine().number("toolChangeMinZ")) {
      const Interval &z = before.at(Axis::Z);
      if (z.isConstant() && !before.inMachineCoordinates(Axis::Z) &&
          before.must(Fact::MovedSinceTool) && z.value() < *lowest) {
        if (auto finding = ctx.report(event))
          finding.message("the tool is changed at Z{0}, below the safe Z{1}", z.value(), *lowest);
        return;
      }
    }
    // With M06 a machining centre takes the tool to its own change position.
    const bool atOnce = ctx.dialect().isLathe() || ctx.dialect().toolChangeByT;
    if (!atOnce || !before.must(Fact::Cut) || before.may(Fact::AwayFromPart))
      return;
    if (auto finding = ctx.report(event, !before.may(Fact::UnknownCode)))
      finding.message(
          "the tool is changed where the last cut ended: the next one may hit part, chuck "
          "or clamps");
  }
};

} // namespace
NCVET_RULE(ToolChangeNearPart, tool_change_near_part)
} // namespace ncvet
