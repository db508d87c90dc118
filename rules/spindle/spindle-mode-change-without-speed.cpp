// The speed mode changed without a new S, and an S that does not fit its mode.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/text/number_text.h"

namespace ncvet {
namespace {

struct SpindleModeChangeWithoutSpeedMemory {
  OncePerCause once;
};

class SpindleModeChangeWithoutSpeed final
    : public StatefulRule<SpindleModeChangeWithoutSpeedMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Motion, EventKind::CycleRun, EventKind::SpeedWord});
    highestCuttingSpeed_ = to.number("cuttingSpeedAbove", 1000);
    unitOpen_ = to.flag("unitOpen");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::SpeedWord)
      atSpeed(event, ctx);
    else
      atCut(event, ctx);
  }

private:
  /// Reported where the mode changes, but only when something is cut with the old number.
  void atCut(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (event.code == noCode || state.profile == ProfileMode::Recorded ||
        !state.must(Fact::SpeedSet) || state.may(Fact::SpeedSinceMode) ||
        state.may(Fact::UnknownCode))
      return sleepInShape();
    if (event.kind == EventKind::Motion &&
        (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
         event.motion == MotionKind::Skip))
      return sleepInShape();
    if (!(state.spindle & (spindleCw | spindleCcw))) // it stops, and another one may cut
      return;
    if (!state.origin.of(StatePart::Speed).known()) // an unknown program may have set it
      return;
    const CodeInfo *mode = state.activeCode(ctx.dialect(), StandardGroup::SpeedMode);
    const Origin origin = state.originOf(ctx.dialect(), StandardGroup::SpeedMode);
    if (!mode || !origin.known())
      return;
    const CausePlace place = causePlace(ctx, origin);
    if (!place.isCause && !memory().once.speaks(origin, ctx))
      return;
    const bool surface = mode->action == Action::SurfaceSpeed;
    if (auto finding = ctx.report(place.at)) {
      std::string number = "the old S";
      if (state.speed->isConstant())
        number = "S" + shortNumber(state.speed->value());
      finding
          .message("`{0}`{3} comes without an S: {1} counts as {2} from here on", mode->name,
                   number, surface ? "cutting speed" : "revolutions per minute",
                   place.isCause ? "" : " " + place.where)
          .note(state.origin.of(StatePart::Speed),
                "the speed is programmed here, for the other mode")
          .note(place.other, place.note("the first cut with it is here", "the mode changes here"));
    }
  }

  /// `S160 LIMS=2200 M3` where speeds are revolutions: what would need the limit is not on.
  static void besideLimit(const Event &event, RuleContext &ctx) {
    constexpr double highestUsual = 400; // m/min
    constexpr unsigned furthest = 10;
    const MachineState &state = ctx.after();
    const Word *const limit = llvm::find_if(ctx.block().words, [&](const Word &word) {
      return word.address != letterAddress('S') && word.isNumber() && word.value() > highestUsual &&
             ctx.dialect().addresses[word.address].unit == AddressUnit::Speed;
    });
    if (limit == ctx.block().words.end() || event.speed().value() > highestUsual ||
        event.word->address != letterAddress('S') || !(state.spindle & (spindleCw | spindleCcw)) ||
        state.may(Fact::UnknownCode))
      return;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i)
      if (findCode(ctx.dialect(), next, {Action::SurfaceSpeed}))
        return;
    if (auto finding = ctx.report(event))
      finding.message(
          "`{0}` is a speed in revolutions, and `{1}` beside it limits the spindle of a "
          "cutting speed, which is not on",
          ctx.text(*event.word), ctx.text(*limit));
  }

  void atSpeed(const Event &event, RuleContext &ctx) const {
    if (event.limitsSpeed() || !event.speed().isConstant())
      return;
    const MachineState &state = ctx.after();
    if (state.isActive(ctx.dialect(), StandardGroup::SpeedMode, {Action::SurfaceSpeed}) ==
        Truth::No)
      return besideLimit(event, ctx);
    if (state.activeAction(ctx.dialect(), StandardGroup::SpeedMode) != Action::SurfaceSpeed)
      return;
    constexpr double feetPerMetre = 3.28;
    const GroupIndex units = ctx.dialect().group(StandardGroup::Units);
    const bool inch =
        units != noGroup &&
        ((unitOpen_ && !state.mayBeStated(units)) ||
         (state.active(ctx.dialect(), StandardGroup::Units) != groupUnset &&
          state.isActive(ctx.dialect(), StandardGroup::Units, {Action::Inch}) != Truth::No));
    // A number above the limit of the spindle is no speed in revolutions either.
    const bool aboveLimit =
        state.speedLimit->isConstant() && event.speed().value() > state.speedLimit->value();
    const double highest = highestCuttingSpeed_ * (inch ? feetPerMetre : 1);
    constexpr double beyondAll = 2; // times what a speed in revolutions may be mistaken for
    if (event.speed().value() <= highest * (aboveLimit ? beyondAll : 1) || isForAnotherSpindle(ctx))
      return;
    if (auto finding = ctx.report(event)) {
      const CodeInfo *mode = state.activeCode(ctx.dialect(), StandardGroup::SpeedMode);
      if (aboveLimit) {
        finding.severity(Severity::Warning)
            .message("`{0}` counts as cutting speed under `{1}`, and no tool cuts as fast",
                     ctx.text(*event.word), mode->name);
        return;
      }
      finding
          .message(
              "`{0}` counts as cutting speed under `{1}`: it looks like revolutions per minute",
              ctx.text(*event.word), mode->name)
          .note(state.originOf(ctx.dialect(), StandardGroup::SpeedMode),
                "`" + mode->name + "` becomes active here");
    }
  }

  /// The S of a live tool has its M code beside it, which may be the builder's.
  static bool isForAnotherSpindle(const RuleContext &ctx) {
    return llvm::any_of(ctx.block().words, [&](const Word &word) {
      if (word.address != letterAddress('M'))
        return false;
      const CodeIndex code = ctx.dialect().find('M', word.codeNumber());
      if (code == noCode)
        return true;
      const Action action = ctx.dialect().codes[code].action;
      return action == Action::LiveToolCw || action == Action::LiveToolCcw ||
             action == Action::MachineSpecific;
    });
  }

  double highestCuttingSpeed_ = 1000; // m/min
  bool unitOpen_ = false;             ///< a program that states no unit may be in feet
};

} // namespace
NCVET_RULE(SpindleModeChangeWithoutSpeed, spindle_mode_change_without_speed)
} // namespace ncvet
