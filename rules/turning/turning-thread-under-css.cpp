// A thread or a hole is cut while constant surface speed is active.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <cmath>

namespace ncvet {
namespace {

class TurningThreadUnderCss final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::CycleRun, EventKind::Motion}); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.dialect().group(StandardGroup::SpeedMode) == noGroup)
      return;
    const CodeInfo &code = ctx.code(event);
    const MachineState &state = ctx.after();
    const bool cycle = event.kind == EventKind::CycleRun;
    const bool thread = cycle ? cutsThread(code.cycle) || code.cycle == CycleKind::ThreadChain ||
                                    code.cycle == CycleKind::ThreadInfeed || taps(code.cycle)
                              : event.motion == MotionKind::Thread;
    if (!thread && !mayDrill(event, code, ctx))
      return sleepInShape();
    // The driven tool turns, and what the work's spindle does is of no interest.
    if (cycle && taps(code.cycle) && (state.liveTool & (spindleCw | spindleCcw)))
      return;
    if (!thread && !isOnAxis(state))
      return;
    if (state.active(ctx.dialect(), StandardGroup::SpeedMode) == groupUnset)
      return;
    const Truth css =
        state.isActive(ctx.dialect(), StandardGroup::SpeedMode, {Action::SurfaceSpeed});
    if (css == Truth::No)
      return;
    if ((!thread && !drills(event, ctx)) ||
        (css == Truth::Unknown && (state.may(Fact::UnknownCode) ||
                                   !state.isStated(ctx.dialect().group(StandardGroup::SpeedMode)))))
      return;
    const Word *word = ctx.codeWord(event);
    if (!word && cycle) // a further pass or hole of what was reported already
      return;
    if (auto finding = ctx.report(word ? ctx.range(*word) : ctx.blockRange(),
                                  event.certain && css == Truth::Yes)) {
      if (thread)
        finding.message(
            "`{0}` cuts a thread under constant surface speed: the spindle changes its speed "
            "between the passes",
            cutter(ctx, event, thread && !cycle).name);
      else
        finding.message(
            "`{0}` drills on the axis under constant surface speed: the spindle runs at its "
            "highest speed",
            code.name);
      finding.note(state.originOf(ctx.dialect(), StandardGroup::SpeedMode),
                   "constant surface speed is selected here");
      fix(finding, ctx);
    }
  }

private:
  /// A hole along the spindle's axis by a cycle of drilling or of grooves in a face, or a feed move
  /// into the work.
  static bool mayDrill(const Event &event, const CodeInfo &code, const RuleContext &ctx) {
    if (!ctx.dialect().isLathe())
      return false;
    if (event.kind == EventKind::CycleRun)
      return makesHole(code.cycle) || code.cycle == CycleKind::GrooveFace;
    return event.motion == MotionKind::Feed && event.axes == 1u << unsigned(Axis::Z);
  }

  /// On the axis every surface speed asks for the highest speed of all.
  static bool isOnAxis(const MachineState &state) {
    const Interval &x = state.at(Axis::X);
    return x.isConstant() && std::fabs(x.value()) < 1e-6;
  }
  static bool drills(const Event &event, const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    if (toolAxis(ctx.dialect(), state) != Axis::Z || state.inMachineCoordinates(Axis::X))
      return false;
    return event.kind == EventKind::CycleRun || isDrilledByMove(event, ctx);
  }

  /// Fed in along Z on the axis, and out again the same way: a tool for turning goes aside.
  static bool isDrilledByMove(const Event &event, const RuleContext &ctx) {
    const Interval &from = ctx.before().at(Axis::Z), &to = ctx.after().at(Axis::Z);
    if (!event.certain || !from.isConstant() || !to.isConstant() || to.value() >= from.value() ||
        ctx.after().profile != ProfileMode::Off || ctx.after().may(Fact::UnknownCode))
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    if (!ahead.next(next) || axesOf(ctx.dialect(), next) != 1u << unsigned(Axis::Z) ||
        !findCode(ctx.dialect(), next, {Action::Rapid}))
      return false;
    if (const Word *w = next.find(letterAddress('W')))
      return w->isNumber() && w->value() > 0;
    const Word *const z = next.find(letterAddress('Z'));
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    return z && z->isNumber() && unit && z->value() * *unit >= from.value();
  }

  /// Of two motion codes in the block the one that cuts a thread.
  static const CodeInfo &cutter(const RuleContext &ctx, const Event &event, bool stroke) {
    for (const CodeUse &use : ctx.codes())
      if (stroke && ctx.code(use).action == Action::Thread)
        return ctx.code(use);
    return ctx.code(event);
  }

  /// The speed that the surface speed gives at the start diameter, as a constant one.
  static void fix(FindingBuilder &finding, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const auto unit = millimetresPer(ctx.dialect(), before);
    const Interval &x = before.at(Axis::X);
    constexpr double pi = 3.14159265358979323846;
    if (!unit || *unit != 1 || !x.isConstant() || x.value() < 1 || !before.speed->isConstant() ||
        before.speed->value() <= 0 || before.inMachineCoordinates(Axis::X))
      return;
    const double speed = std::floor(before.speed->value() * 1000 / (pi * x.value()));
    constexpr double fastest = 12'000; // 1/min; a greater one comes of a wrong S
    if (speed < 1 || speed > fastest)
      return;
    const std::string block = formatted("G97 S{0}", int64_t(speed));
    finding.fix(FixSafety::Unsafe, "insert " + block + " before this block",
                ctx.insertBlockBefore(block));
  }
};

} // namespace
NCVET_RULE(TurningThreadUnderCss, turning_thread_under_css)
} // namespace ncvet
