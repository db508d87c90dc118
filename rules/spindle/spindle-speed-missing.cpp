// A spindle without a speed, with none above zero, or with that of the tool before.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct SpindleSpeedMissingMemory {
  OncePerCause once;
  TextPlace cutWith; ///< the S with which the tool before has cut; offset 0: none
};

class SpindleSpeedMissing final : public StatefulRule<SpindleSpeedMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::SpindleChange, EventKind::CycleStart, EventKind::SpeedWord});
    usesUp_ =
        llvm::any_of(to.dialect().codes, [](const CodeInfo &code) { return code.leavesNoSpeed; });
    const auto &switches = to.dialect().switches;
    otherMaster_ = size_t(
        llvm::find_if(switches, [](const SwitchInfo &one) { return one.id == "other-master"; }) -
        switches.begin());
    perRevolution_ = to.dialect().facts->feed.perRevolutionNeedsSpeed;
    if (perRevolution_ || !to.dialect().isLathe())
      to.onChange({EventKind::Motion});
    if (!to.dialect().isLathe()) {
      to.on(EventKind::ToolChange);
      to.onChange({EventKind::CycleRun});
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::SpeedWord)
      atSpeed(event, ctx);
    else if (event.kind == EventKind::ToolChange)
      atToolChange(ctx);
    else if (event.kind == EventKind::Motion)
      atFeed(event, ctx);
    else if (event.kind == EventKind::CycleRun)
      atCycle(event, ctx);
    else
      atStart(event, ctx);
  }

private:
  /// The S is in one of the next blocks, and nothing moves before it.
  static bool comesAtOnce(const RuleContext &ctx) {
    constexpr unsigned furthest = 3; // blocks
    const auto limits = [&](const Block &next) {
      return findCode(ctx.dialect(), next, {Action::SpeedLimit}) != nullptr;
    };
    return comesInTime(
        ctx, furthest,
        [&](const Block &next) { return next.has(letterAddress('S')) && !limits(next); },
        [&](const Block &next) {
          return next.has(letterAddress('S')) || namesAxes(ctx.dialect(), next) ||
                 !next.items.empty();
        });
  }

  void atToolChange(RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    memory().cutWith = before.must(Fact::CutSinceTool) && before.must(Fact::SpeedSet)
                           ? placeOf(before.origin.of(StatePart::Speed))
                           : TextPlace();
  }

  void atStart(const Event &event, RuleContext &ctx) const {
    if (event.code == noCode || ctx.before().profile == ProfileMode::Recorded)
      return sleepInShape();
    const CodeInfo &code = ctx.code(event);
    const bool starts = code.action == Action::SpindleCw || code.action == Action::SpindleCcw;
    // Beside its opposite it is told as a conflict.
    if (starts && ctx.find({Action::SpindleCw}) && ctx.find({Action::SpindleCcw}))
      return sleepInShape();
    if (ctx.after().must(Fact::SpeedSet)) {
      // An S0 of an earlier block; in the same block the S itself is reported.
      if (!starts || ctx.after().speed->hi > 0 || ctx.block().has(letterAddress('S')))
        return sleepInShape();
      if (auto finding = ctx.report(event))
        finding.message("`{0}` starts the spindle with a speed of zero", code.name)
            .note(ctx.after().origin.of(StatePart::Speed), "the speed is programmed here");
      return;
    }
    const bool turnsInCycle = tapsRigidly(code.cycle) || code.spindle == SpindleNeed::StartsItself;
    if (!starts && !turnsInCycle)
      return sleepInShape();
    // A tap in a driven tool that runs has that one's speed; the spindle needs none.
    if (!starts && code.spindle == SpindleNeed::Any && (ctx.after().liveTool & ~spindleOff))
      return;
    // A cycle that has a word of its own for the speed lacks none: its parameters are another rule.
    if (!starts && llvm::any_of(code.words, [&](const WordSpec &spec) {
          return spec.role == Role::Speed &&
                 (spec.need != Need::Optional || wordFor(ctx.block(), spec));
        }))
      return;
    // The S may come before the cut, where it is asked for again.
    if (starts && usesUp_ && ctx.after().origin.of(StatePart::Speed).known())
      return;
    // The machine's builder may give a speed by a code of his own; a word that cannot be read may
    // have been the S.
    if (ctx.after().may(Fact::UnknownCode) || !ctx.block().issues.empty() ||
        (starts && comesAtOnce(ctx)))
      return;
    const bool certain = event.certain && !ctx.after().may(Fact::SpeedSet);
    if (auto finding = ctx.report(event, certain)) {
      if (starts && isSetByHand(ctx))
        finding.severity(Severity::Style);
      if (starts)
        finding.message("`{0}` starts the spindle, but no speed was programmed", code.name);
      else
        finding.message("`{0}` runs the spindle itself, but no speed was programmed", code.name);
    }
  }

  /// A cycle that cuts with the spindle as it runs.
  void atCycle(const Event &event, RuleContext &ctx) const {
    if (event.code == noCode || ctx.code(event).spindle != SpindleNeed::Running ||
        ctx.before().may(Fact::CutSinceTool))
      return sleepInShape();
    if (mayBeOfToolBefore(ctx) && othersHaveSpeeds(ctx))
      ofToolBefore(event, ctx);
  }

  /// Two other tools of the program at least have an S of their own: drills of one size may share
  /// one.
  static bool othersHaveSpeeds(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    unsigned tools = 0;
    bool counted = false;
    const auto wants = [&](const TextPiece &piece) {
      return piece.hasAny(maskOf(letterAddress('S'))) ||
             piece.mayName(ctx.dialect(), {Action::ToolChange});
    };
    for (const Block &block : blocksWhere(ctx.index(), program, wants)) {
      if (findCode(ctx.dialect(), block, {Action::ToolChange}))
        counted = false;
      if (!block.has(letterAddress('S')) || counted ||
          findCode(ctx.dialect(), block, {Action::SpeedLimit}))
        continue;
      counted = true;
      if (++tools == 2)
        return true;
    }
    return false;
  }

  /// Whether the tool before has cut with the S in force.
  bool mayBeOfToolBefore(const RuleContext &ctx) const {
    return memory().cutWith.offset &&
           memory().cutWith == placeOf(ctx.after().origin.of(StatePart::Speed));
  }

  /// The first cut with a tool that has no S of its own, after one that has cut with this S.
  void ofToolBefore(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const Origin &tool = state.origin.of(StatePart::Tool);
    if (!(state.spindle & (spindleCw | spindleCcw)))
      return; // that it does not turn is another rule's matter
    // The S of another master spindle is a word of its own.
    if (otherMaster_ < ctx.dialect().switches.size() && state.switchMayBeOn(unsigned(otherMaster_)))
      return;
    if (!event.certain || event.code == noCode || ctx.before().may(Fact::CutSinceTool) ||
        !state.must(Fact::SpeedSet) || state.may(Fact::UnknownCode) || !tool.known() ||
        !mayBeOfToolBefore(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("the first cut with this tool runs at the speed of the tool before: it has no S")
          .note(tool, "the tool is changed here")
          .note(state.origin.of(StatePart::Speed), "the speed is programmed here");
  }

  static TextPlace placeOf(const Origin &origin) {
    return origin.known() ? TextPlace{origin.file, origin.begin} : TextPlace();
  }

  /// A feed per revolution of a spindle that has no speed: the control stops.
  void atFeed(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const bool feeds = isFeed(event.motion);
    if (!feeds)
      return sleepInShape();
    const bool none = !state.may(Fact::SpeedSet) ||
                      (state.must(Fact::SpeedSet) && state.speed == Interval::exactly(0));
    if ((!perRevolution_ || !none) && (!usesUp_ || state.may(Fact::SpeedSet)) &&
        (ctx.dialect().isLathe() || ctx.before().may(Fact::CutSinceTool)))
      return sleepInShape();
    if (feeds && !ctx.dialect().isLathe())
      ofToolBefore(event, ctx);
    if (feeds && usesUp_ && !state.may(Fact::SpeedSet))
      afterTap(event, ctx);
    if (!perRevolution_ || !feeds || !none || event.code == noCode ||
        state.may(Fact::UnknownCode) ||
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

  /// The spindle was started before rigid tapping ended, which leaves no speed.
  void afterTap(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const Origin &speed = state.origin.of(StatePart::Speed);
    constexpr uint8_t turning = spindleCw | spindleCcw;
    if (!event.certain || event.code == noCode || state.may(Fact::UnknownCode) || !speed.known() ||
        !state.spindle || (state.spindle & ~turning) || !memory().once.speaks(speed, ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` cuts, and the S of line {1} was for rigid tapping only",
                   ctx.code(event).name, lineOf(ctx, speed))
          .note(speed, "the speed is programmed here");
  }

  void atSpeed(const Event &event, RuleContext &ctx) const {
    if (!event.limitsSpeed())
      memory().cutWith = TextPlace(); // in a loop it is the same place, said anew
    if (event.limitsSpeed() || !event.speed().isConstant() || event.speed().value() > 0)
      return;
    constexpr uint8_t turning = spindleCw | spindleCcw;
    const bool stops = ctx.find({Action::SpindleStop, Action::SpindleOrient});
    const bool runs = ctx.after().spindle && !(ctx.after().spindle & ~turning);
    // `M05 S0` is a habit and does no harm.
    if (event.speed().value() == 0 && (stops || !runs))
      return;
    if (event.speed().value() == 0 && (modulates(ctx) || isOfFurtherSpindle(ctx)))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` is not above zero: the spindle does not turn", ctx.text(*event.word));
  }

  /// `S0 $1`: what is switched so is a laser or a driven tool.
  static bool isOfFurtherSpindle(const RuleContext &ctx) {
    return llvm::any_of(ctx.block().words, [&](const Word &word) {
      return word.isNumber() && word.value() > 0 &&
             llvm::StringRef(ctx.dialect().addressName(word.address)).startswith("$");
    });
  }

  /// The program starts spindles several times, and names no speed at all: it is set by hand.
  static bool isSetByHand(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    unsigned starts = 0;
    const auto wants = [&](const TextPiece &piece) {
      return piece.hasAny(maskOf(letterAddress('S'))) ||
             piece.mayName(ctx.dialect(), {Action::SpindleCw, Action::SpindleCcw});
    };
    for (const Block &block : blocksWhere(ctx.index(), program, wants)) {
      if (block.has(letterAddress('S')))
        return false;
      starts += findCode(ctx.dialect(), block, {Action::SpindleCw, Action::SpindleCcw}) != nullptr;
    }
    return starts > 1;
  }

  /// Moves of the program have an S of their own: it is the power of a laser, which may be none.
  static bool modulates(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    unsigned moves = 0;
    constexpr unsigned enough = 2; // of one a tool may begin to turn on its way
    for (const Block &block : blocksWith(ctx.index(), program, maskOf(letterAddress('S')))) {
      moves += block.has(letterAddress('S')) && !block.has(letterAddress('M')) &&
               block.hasAny(ctx.dialect().axisWords);
      if (moves == enough)
        return true;
    }
    return false;
  }

  bool usesUp_ = false;        ///< codes of the control leave no speed in force
  bool perRevolution_ = false; ///< a feed per revolution needs a speed
  size_t otherMaster_ = 0;     ///< the switch of another master spindle
};

} // namespace
NCVET_RULE(SpindleSpeedMissing, spindle_speed_missing)
} // namespace ncvet
