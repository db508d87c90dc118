// The spindle turns the other way than the cycle needs.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

struct CycleSpindleDirectionMemory {
  Origin tool;               ///< with which the last thread was cut
  uint8_t spindle = 0;       ///< how it turned
  double start = 0, end = 0; ///< of the thread along Z, mm
  SourceRange at{};          ///< its pass
};

class CycleSpindleDirection final : public StatefulRule<CycleSpindleDirectionMemory> {
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
      if (event.kind != EventKind::CycleStart) {
        threadHand(event, code, spindle, ctx);
        sameThread(event, code, spindle, ctx);
      }
      return;
    }
    if (event.kind != EventKind::CycleStart || !makesHole(code.cycle))
      return sleepInShape();
    // Where a cycle may start it itself, the way in which it turns is still what the program says.
    const bool itself = code.spindle == SpindleNeed::StartsItself ||
                        (code.spindle == SpindleNeed::Any && !ctx.dialect().isLathe());
    uint8_t needed = 0;
    if (code.spindle == SpindleNeed::Clockwise)
      needed = spindleCw;
    else if (code.spindle == SpindleNeed::CounterClockwise)
      needed = spindleCcw;
    else if (itself && code.cycle == CycleKind::Tap)
      needed = spindleCw;
    else if (itself && code.cycle == CycleKind::TapLeft)
      needed = spindleCcw;
    if (!needed || needed == spindle || ctx.before().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message(code.spindle == SpindleNeed::StartsItself
                       ? "`{0}` starts with {1} by itself, but the spindle turns with {2}: "
                         "perhaps the tap of the other hand is meant"
                       : "`{0}` needs the spindle turning with {1}, but it turns with {2}",
                   code.name, needed == spindleCw ? "M03" : "M04",
                   spindle == spindleCw ? "M03" : "M04")
          .note(ctx.before().origin.of(StatePart::Spindle), "the spindle is started here");
  }

private:
  /// A pass of a thread that was cut with the spindle turning the other way.
  void sameThread(const Event &event, const CodeInfo &code, uint8_t spindle,
                  RuleContext &ctx) const {
    const Interval &start = ctx.before().at(Axis::Z);
    const auto end = endOf(ctx, Axis::Z, start);
    if (!start.isConstant() || !end || *end == start.value() || ctx.after().may(Fact::UnknownCode))
      return;
    const Memory was = std::exchange(memory(), {ctx.after().origin.of(StatePart::Tool), spindle,
                                                start.value(), *end, ctx.blockRange()});
    if (was.at.empty() || was.tool != memory().tool || was.spindle == spindle ||
        was.start != memory().start || was.end != memory().end)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.severity(Severity::Style)
          .message("`{0}` cuts a thread with {1} that was cut with {2} before: the one is of the "
                   "other hand",
                   code.name, spindle == spindleCw ? "M03" : "M04",
                   was.spindle == spindleCw ? "M03" : "M04")
          .note(was.at, "this pass");
  }

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
