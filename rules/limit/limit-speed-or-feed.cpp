// A spindle speed lies above the clamp that the program set.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/number_text.h"

#include <utility>

namespace ncvet {
namespace {

struct LimitSpeedOrFeedMemory {
  SourceRange lowered{}; ///< the word that set the limit below the speed in force
};

class LimitSpeedOrFeed final : public StatefulRule<LimitSpeedOrFeedMemory> {
public:
  void listen(Subscriptions &to) override {
    always_ = to.dialect().facts->spindle.inRevolutions;
    to.on(EventKind::SpeedWord);
    to.onCode([](const CodeInfo &code) { return code.action == Action::Cycle && speedOf(code); });
    to.onChange({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return ofCycle(event, ctx);
    if (event.kind != EventKind::SpeedWord)
      return cuts(event, ctx);
    const MachineState &state = ctx.after();
    if (event.limitsSpeed()) {
      memory().lowered = isAbove(ctx.before().speed, ctx) ? ctx.range(*event.word) : SourceRange();
      return;
    }
    memory().lowered = {};
    if (!isAbove(event.speed(), ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "`{0}` lies above the speed limit of {1} 1/min: the spindle turns no faster than that",
          ctx.text(*event.word), shortNumber(state.speedLimit->value()));
  }

private:
  /// The word by which a cycle gives the spindle a speed of its own.
  static const WordSpec *speedOf(const CodeInfo &code) {
    for (const WordSpec &spec : code.words)
      if (spec.role == Role::Speed)
        return &spec;
    return nullptr;
  }

  void ofCycle(const Event &event, RuleContext &ctx) const {
    const Word *word = wordFor(ctx.block(), *speedOf(ctx.code(event)));
    if (!word || !isAbove(ctx.value(*word), ctx))
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding.message(
          "`{0}` lies above the speed limit of {1} 1/min: the spindle turns no faster than that",
          ctx.text(*word), shortNumber(ctx.after().speedLimit->value()));
  }

  /// Whether the speed is one in revolutions, and above the limit.
  bool isAbove(const Interval &speed, const RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (!state.must(Fact::SpeedLimitSet) || !state.speedLimit->isConstant())
      return false;
    if (!always_ && (ctx.dialect().group(StandardGroup::SpeedMode) == noGroup ||
                     state.isActive(ctx.dialect(), StandardGroup::SpeedMode,
                                    {Action::ConstantSpeed}) != Truth::Yes))
      return false;
    return speed.lo > state.speedLimit->value();
  }

  /// The limit was set for what comes: only a cut at the old speed shows that it was not.
  void cuts(const Event &event, RuleContext &ctx) const {
    if (memory().lowered.end == 0)
      return;
    const MachineState &state = ctx.after();
    if (event.kind == EventKind::Motion &&
        (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
         event.inMachineCoordinates()))
      return;
    const SourceRange lowered = std::exchange(memory().lowered, {});
    if (!(state.spindle & (spindleCw | spindleCcw)) || !isAbove(state.speed, ctx))
      return;
    if (auto finding = ctx.report(lowered, event.certain))
      finding
          .message("`{0}` sets the limit below the speed of {1} 1/min that is in force and cuts: "
                   "the spindle turns no faster than the limit",
                   ctx.text(lowered), shortNumber(state.speed->lo))
          .note(ctx.blockRange(), "the cut at that speed");
  }

  bool always_ = false; ///< every S is a speed in revolutions
};

} // namespace
NCVET_RULE(LimitSpeedOrFeed, limit_speed_or_feed)
} // namespace ncvet
