// The spindle is started while clamped or open, the chuck opens while it turns, or a clamped axis
// moves.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

struct MotionClampConflictMemory {
  uint16_t clamped = 0; ///< axes that the clamping codes hold
};

class MotionClampConflict final : public StatefulRule<MotionClampConflictMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::SpindleCw, Action::SpindleCcw, Action::ChuckOpen});
    // Which axes the clamping codes hold is the machine's business.
    if (const auto axes = to.machine().option("clampedAxes"))
      for (unsigned i = 0; i < axisCount; ++i)
        if (axes->contains("XYZABCUVW"[i]))
          memory().clamped |= uint16_t(1u << i);
    for (size_t i = 0; i < to.dialect().switches.size(); ++i)
      if (to.dialect().switches[i].leftOn == "motion-clamp-conflict")
        switches_ |= 1u << i;
    if (memory().clamped && switches_)
      to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion)
      return clamped(event, ctx);
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
            .note(before.origin.of(StatePart::Spindle), "the spindle is started here");
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

private:
  void clamped(const Event &event, RuleContext &ctx) const {
    if (!(event.axes & memory().clamped) ||
        !(ctx.before().switches.areOn(switches_) & ctx.after().switches.areOn(switches_)))
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if ((address.kind != AddressKind::Axis && address.kind != AddressKind::Increment) ||
          !(memory().clamped >> unsigned(address.axis) & 1))
        continue;
      if (auto finding = ctx.report(word, event.certain))
        finding.message("`{0}` moves an axis that is clamped", ctx.text(word));
      return;
    }
  }

  uint32_t switches_ = 0; ///< that say that axes are clamped
};

} // namespace
NCVET_RULE(MotionClampConflict, motion_clamp_conflict)
} // namespace ncvet
