// The spindle turns the other way than the cycle needs.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class CycleSpindleDirection final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::CycleStart, EventKind::CycleRun});
    if (to.dialect().isLathe())
      to.onMoves({MotionKind::Thread});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    // The spindle as the block leaves it, unless the cycle turns it itself.
    uint8_t spindle = ctx.before().spindle;
    for (const CodeUse &use : ctx.codes()) {
      if (ctx.code(use).action == Action::SpindleCw)
        spindle = spindleCw;
      else if (ctx.code(use).action == Action::SpindleCcw)
        spindle = spindleCcw;
    }
    if (spindle != spindleCw && spindle != spindleCcw)
      return sleepInShape();
    if (event.kind == EventKind::Motion || cutsThread(code.cycle)) {
      if (event.kind != EventKind::CycleStart)
        threadHand(event, code, spindle, ctx);
      return;
    }
    if (event.kind != EventKind::CycleStart || !makesHole(code.cycle))
      return sleepInShape();
    uint8_t needed = 0;
    if (code.spindle == SpindleNeed::Clockwise)
      needed = spindleCw;
    else if (code.spindle == SpindleNeed::CounterClockwise)
      needed = spindleCcw;
    else if (code.spindle == SpindleNeed::StartsItself && code.cycle == CycleKind::Tap)
      needed = spindleCw;
    else if (code.spindle == SpindleNeed::StartsItself && code.cycle == CycleKind::TapLeft)
      needed = spindleCcw;
    if (!needed || needed == spindle || ctx.before().may(Fact::UnknownCode))
      return;
    const bool itself = code.spindle == SpindleNeed::StartsItself;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message(itself ? "`{0}` starts with {1} by itself, but the spindle turns with {2}: "
                            "perhaps the tap of the other hand is meant"
                          : "`{0}` needs the spindle turning with {1}, but it turns with {2}",
                   code.name, needed == spindleCw ? "M03" : "M04",
                   spindle == spindleCw ? "M03" : "M04")
          .note(ctx.before().origin.of(StatePart::Spindle), "the spindle is started here");
  }

private:
  /// Right-hand threads on a rear turret: M03 towards -Z, M04 towards +Z.
  static void threadHand(const Event &event, const CodeInfo &code, uint8_t spindle,
                         RuleContext &ctx) {
    const auto rear = ctx.machine().option("rearTurret");
    if (!rear || *rear != "true")
      return;
    const Interval &start = ctx.before().at(Axis::Z);
    const auto end = endOf(ctx, Axis::Z, start);
    if (!start.isConstant() || !end || *end == start.value())
      return;
    const bool towardsMinus = *end < start.value();
    const uint8_t needed = towardsMinus ? spindleCw : spindleCcw;
    if (needed == spindle)
      return;
    const Word *named = ctx.codeWord(event), *word = named ? named : event.word;
    if (!word)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding
          .message("`{0}` cuts towards {1} with {2}: on a rear turret that is a "
                   "left-hand thread",
                   code.name, towardsMinus ? "-Z" : "+Z", spindle == spindleCw ? "M03" : "M04")
          .severity(Severity::Warning)
          .note(ctx.before().origin.of(StatePart::Spindle), "the spindle is started here");
  }
};

} // namespace
NCVET_RULE(CycleSpindleDirection, cycle_spindle_direction)
} // namespace ncvet
