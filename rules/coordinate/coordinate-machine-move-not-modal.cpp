// A block looks as if the machine coordinates of the block before were still in force.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CoordinateMachineMoveNotModal final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Motion});
    least_ = to.option("least", 100);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (event.number || event.motion == MotionKind::Reference || event.motion == MotionKind::Skip ||
        !event.axes || !before.must(Fact::AtMachinePosition) || (event.axes & before.machineAxes) ||
        !before.machineAxes || before.must(Fact::ReferenceReturned))
      return;
    // The retract axes of the machine: all of a lathe, the tool axis of a mill.
    const auto likely = ctx.dialect().isLathe()
                            ? uint16_t(1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z))
                            : uint16_t(1u << unsigned(toolAxis(ctx.dialect(), after)));
    if (event.axes & ~likely)
      return;
    for (unsigned axis = 0; axis < axisCount; ++axis)
      if ((event.axes >> axis & 1) && !(after.position[axis].hi <= -least_))
        return;
    if (auto finding = ctx.report(event))
      finding.message(
          "this value looks like a machine position, but the machine coordinates of the "
          "block before do not hold: it is driven in work coordinates");
  }

private:
  double least_ = 100;
};

} // namespace
NCVET_RULE(CoordinateMachineMoveNotModal, coordinate_machine_move_not_modal)
} // namespace ncvet
