// C axis words while the C axis is not coupled to the spindle.
#include "analyzer/rule/report_once.h"

namespace ncvet {
namespace {

class SpindleCAxisNotEngaged final : public Rule {
public:
  void listen(Subscriptions &to) override {
    // Only where the table has a code that engages the axis.
    if (llvm::any_of(to.dialect().codes,
                     [](const CodeInfo &code) { return code.action == Action::AxisEngage; }))
      to.onChange({EventKind::Motion, EventKind::CycleRun, EventKind::CycleStart});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const bool released = ctx.find({Action::AxisRelease});
    const MachineState &state = released ? ctx.before() : ctx.after();
    if (!(event.axes >> unsigned(Axis::C) & 1) || state.must(Fact::AxisEngaged) ||
        (state.may(Fact::AxisEngaged) && state.may(Fact::UnknownCode)))
      return;
    const Word *word = nullptr;
    for (const Word &each : ctx.block().words)
      if ((ctx.dialect().axisWords & maskOf(each.address)) &&
          ctx.dialect().addresses[each.address].axis == Axis::C)
        word = &each;
    if (!word)
      return;
    const bool certain =
        event.certain && !state.may(Fact::AxisEngaged) && !state.may(Fact::UnknownCode);
    if (auto finding = ctx.report(*word, certain)) {
      std::string by;
      for (const CodeInfo &code : ctx.dialect().codes)
        if (code.action == Action::AxisEngage && by.empty())
          by = code.name;
      finding.message(
          "`{0}` while the C axis is not engaged: the control stops with an alarm; `{1}` "
          "engages it",
          ctx.text(*word), by);
    }
  }
};

} // namespace
NCVET_RULE(SpindleCAxisNotEngaged, spindle_c_axis_not_engaged)
} // namespace ncvet
