// The spindle is started while clamped or open, or the chuck opens while it turns.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class MotionClampConflict final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::SpindleCw, Action::SpindleCcw, Action::ChuckOpen});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const CodeInfo &code = ctx.code(event);
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (code.action == Action::ChuckOpen) {
      constexpr uint8_t turning = spindleCw | spindleCcw;
      // Stopped in this block, or nobody knows: silent.
      if (!(before.spindle & turning) || !(after.spindle & turning) ||
          (before.spindle == spindleAny && !before.must(Fact::SpindleStated)))
        return;
      const bool certain = !(before.spindle & ~turning);
      if (!certain && (before.may(Fact::UnknownCode) || before.spindle == spindleAny))
        return;
      if (auto finding = ctx.report(event, certain))
        finding.message("`{0}` opens the chuck while the spindle turns", ctx.text(*event.word))
            .note(before.origin.spindle, "the spindle is started here");
      return;
    }
    const struct {
      Fact fact;
      const char *what;
    } obstacles[] = {{Fact::ChuckOpen, "while the chuck is open"},
                     {Fact::SpindleClamped, "while the spindle is clamped"},
                     {Fact::AxisEngaged, "while it is coupled as the C axis"}};
    for (const auto &obstacle : obstacles) {
      if (!before.must(obstacle.fact) || !after.must(obstacle.fact))
        continue;
      if (auto finding = ctx.report(event))
        finding.message("`{0}` starts the spindle {1}", ctx.text(*event.word), obstacle.what);
      return;
    }
  }
};

} // namespace
NCVET_RULE(MotionClampConflict, motion_clamp_conflict)
} // namespace ncvet
