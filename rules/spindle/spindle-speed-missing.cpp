// A spindle that is started without a speed, or with none above zero.
#include "analyzer/rule/report_once.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct SpindleSpeedMissingMemory {
  OncePerCause once;
};

class SpindleSpeedMissing final : public StatefulRule<SpindleSpeedMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::SpindleChange, EventKind::CycleStart, EventKind::SpeedWord});
    if (to.dialect().facts->feed.perRevolutionNeedsSpeed)
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::SpeedWord)
      atSpeed(event, ctx);
    else if (event.kind == EventKind::Motion)
      atFeed(event, ctx);
    else
      atStart(event, ctx);
  }

private:
  static void atStart(const Event &event, RuleContext &ctx) {
    if (event.code == noCode || ctx.before().profile == ProfileMode::Recorded)
      return;
    const CodeInfo &code = ctx.code(event);
    const bool starts = code.action == Action::SpindleCw || code.action == Action::SpindleCcw;
    if (ctx.after().must(Fact::SpeedSet)) {
      // An S0 of an earlier block; in the same block the S itself is reported.
      if (starts && ctx.after().speed->hi <= 0 && !ctx.block().has(letterAddress('S')))
        if (auto finding = ctx.report(event))
          finding.message("`{0}` starts the spindle with a speed of zero", code.name)
              .note(ctx.after().origin.of(StatePart::Speed), "the speed is programmed here");
      return;
    }
    const bool taps = code.cycle == CycleKind::RigidTap || code.cycle == CycleKind::RigidTapLeft ||
                      code.spindle == SpindleNeed::StartsItself;
    if (!starts && !taps)
      return;
    // A tap in a driven tool that runs has that one's speed; the spindle needs none.
    if (!starts && code.spindle == SpindleNeed::Any && (ctx.after().liveTool & ~spindleOff))
      return;
    // A cycle that has a word of its own for the speed lacks none: its parameters are another rule.
    if (!starts && llvm::any_of(code.words, [](const WordSpec &spec) {
          return spec.role == Role::Speed && spec.need != Need::Optional;
        }))
      return;
    // The machine's builder may give a speed by a code of his own.
    if (ctx.after().may(Fact::UnknownCode))
      return;
    const bool certain = event.certain && !ctx.after().may(Fact::SpeedSet);
    if (auto finding = ctx.report(event, certain)) {
      if (starts)
        finding.message("`{0}` starts the spindle, but no speed was programmed", code.name);
      else
        finding.message("`{0}` runs the spindle itself, but no speed was programmed", code.name);
    }
  }

  /// A feed per revolution of a spindle that has no speed: the control stops.
  void atFeed(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const bool feeds = event.motion == MotionKind::Feed || event.motion == MotionKind::ArcCw ||
                       event.motion == MotionKind::ArcCcw;
    const bool none = !state.may(Fact::SpeedSet) ||
                      (state.must(Fact::SpeedSet) && state.speed == Interval::exactly(0));
    if (!feeds || !none || event.code == noCode || state.may(Fact::UnknownCode) ||
        state.activeAction(ctx.dialect(), StandardGroup::FeedMode) != Action::FeedPerRevolution)
      return;
    const Origin mode = state.originOf(ctx.dialect(), StandardGroup::FeedMode);
    if (!memory().once.speaks(mode, ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Error)
          .message("`{0}` feeds per revolution, and the spindle has no speed: the control stops",
                   ctx.code(event).name)
          .note(mode, "feed per revolution is switched on here");
  }

  static void atSpeed(const Event &event, RuleContext &ctx) {
    if (event.limitsSpeed() || !event.speed().isConstant() || event.speed().value() > 0)
      return;
    constexpr uint8_t turning = spindleCw | spindleCcw;
    const bool stops = ctx.find({Action::SpindleStop, Action::SpindleOrient});
    const bool runs = ctx.after().spindle && !(ctx.after().spindle & ~turning);
    // `M05 S0` is a habit and does no harm.
    if (event.speed().value() == 0 && (stops || !runs))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` is not above zero: the spindle does not turn", ctx.text(*event.word));
  }
};

} // namespace
NCVET_RULE(SpindleSpeedMissing, spindle_speed_missing)
} // namespace ncvet
