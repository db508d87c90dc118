// A feed move or a cutting cycle while the spindle does not turn.
#include "analyzer/facts/block_before.h"
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/measuring_tool.h"
#include "analyzer/facts/silent_program.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/evaluate/tool_data.h"

namespace ncvet {
namespace {

struct SpindleOffWhileCuttingMemory {
  OncePerCause once;
  OncePerCause unsaid; ///< the program has said nothing of tool, speed and spindle
};

class SpindleOffWhileCutting final : public StatefulRule<SpindleOffWhileCuttingMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Motion, EventKind::CycleRun});
    anyMachine_ = to.flag("anyMachine");
    builderStarts_ = to.flag("builderStarts");
    startWhereNamed_ = to.flag("startWhereNamed");
    masterFeeds_ = to.flag("masterFeeds");
    const auto &switches = to.dialect().switches;
    otherMaster_ = unsigned(
        llvm::find_if(switches, [](const SwitchInfo &one) { return one.id == "other-master"; }) -
        switches.begin());
    const MachineProfile &machine = to.machine();
    top_ = machine.stock && machine.stock->max[2] ? machine.stock->max[2]
                                                  : machine.number("stockTopZ");
    hasHead_ = llvm::any_of(to.dialect().codes,
                            [](const CodeInfo &c) { return c.action == Action::ProgramHead; });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = cuts(event, ctx);
    if (ctx.before().profile == ProfileMode::Recorded && code.action != Action::ProfileRun)
      return;
    if (!(event.kind == EventKind::Motion ? feeds(event, code, ctx) : runs(event, code, ctx)))
      return sleepInShape();
    // After rigid tapping another rule speaks.
    if (ctx.before().may(Fact::SpindleStoppedByTap))
      return sleepInShape();
    // M05 stops after the block's move, M03 starts before it; a hole in a block that moves nowhere
    // is made after everything.
    const bool last = event.kind == EventKind::CycleRun && code.firesOnEveryBlock && !event.axes;
    const MachineState &state =
        ctx.find({Action::SpindleStop}) && !last ? ctx.before() : ctx.after();
    uint8_t live = ctx.find({Action::LiveToolStop}) ? ctx.before().liveTool : ctx.after().liveTool;
    // The feed per revolution is that of the main spindle, whatever else turns.
    const bool perRevolution = state.isActive(ctx.dialect(), StandardGroup::FeedMode,
                                              {Action::FeedPerRevolution}) == Truth::Yes;
    if (perRevolution && masterFeeds_ &&
        (otherMaster_ >= ctx.dialect().switches.size() || !state.switchMayBeOn(otherMaster_)))
      live = spindleOff;
    if (!mayStop(state.spindle, live))
      return sleepInShape();
    if (event.kind == EventKind::Motion && (isAboveStock(ctx) || isInAir(event, ctx)))
      return;
    const bool may = mayTurn(state.spindle, live);
    if (may && ctx.after().may(Fact::UnknownCode))
      return;
    if (const ToolData *tool = toolInUse(ctx.machine(), state); tool && tool->kind == "probe")
      return;
    const Origin &origin = state.origin.of(StatePart::Spindle);
    // What is before a fragment may have started the spindle.
    if (nothingSaid(state) && (hasHead_ || anyMachine_) &&
        (!memory().unsaid.speaks(origin, ctx) || (hasHead_ && isFragment(ctx)) ||
         (anyMachine_ && saysNothingOfTools(ctx))))
      return;
    if (!memory().once.maySpeak(origin, ctx) || toolMeasures(ctx, measuring_) ||
        (builderStarts_ ? builderMayTurnSpindle(ctx) : builderTurnsAll(ctx)) ||
        (builderStarts_ && isStartedByBuilder(origin, ctx)) || isForHandling(state, ctx) ||
        isBackBoring(state, ctx) || !memory().once.speaks(origin, ctx) ||
        (startWhereNamed_ && namesNoSpindle(ctx)))
      return;
    const bool byHand = !state.may(Fact::SpindleStated) && stopsForHand(ctx);
    if (auto finding = ctx.report(ctx.blockRange(), event.certain && !may && !byHand)) {
      finding.severity(severityOf(state, byHand, ctx));
      if (last)
        holeOfStop(event, code, finding, ctx);
      finding
          .message("`{0}` cuts while the spindle {1}{2}", code.name,
                   state.may(Fact::SpindleStated) ? "is stopped" : "was never started",
                   perRevolution ? ": with feed per revolution the machine waits for ever"
                                 : ": the tool breaks at the first contact")
          .note(state.may(Fact::SpindleStated) ? origin : Origin(), "the spindle is stopped here");
    }
  }

private:
  /// What runs: at the places of a pattern that is the cycle in force.
  static const CodeInfo &cuts(const Event &event, const RuleContext &ctx) {
    const CodeInfo &code = ctx.code(event);
    if (code.cycle != CycleKind::Pattern)
      return code;
    for (const StandardGroup which : {StandardGroup::Cycle, StandardGroup::Motion})
      if (const CodeInfo *active = ctx.after().activeCode(ctx.dialect(), which);
          active && active->action == Action::Cycle)
        return *active;
    return code;
  }

  /// The block moves the tool through the work, as far as its words say.
  static bool feeds(const Event &event, const CodeInfo &code, const RuleContext &ctx) {
    constexpr uint16_t linear =
        uint16_t(~(1u << unsigned(Axis::A) | 1u << unsigned(Axis::B) | 1u << unsigned(Axis::C)));
    if (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
        event.motion == MotionKind::Skip || event.inMachineCoordinates() ||
        !(event.axes & linear) || code.spindle == SpindleNeed::StartsItself)
      return false; // a rotary axis alone positions, or the work turns against a wheel
    // `G1 X` without a number moves nothing.
    const AddressMask axisWords = ctx.dialect().axisWords;
    if (ctx.block().hasAny(axisWords) && llvm::none_of(ctx.block().words, [&](const Word &word) {
          return (axisWords & maskOf(word.address)) && !word.has(wordNoValue);
        }))
      return false;
    // At home of the tool's axis the tool goes to its place, and cuts nothing.
    const Axis tool = toolAxis(ctx.dialect(), ctx.after());
    if (!ctx.dialect().isLathe() && ctx.before().must(Fact::AtMachinePosition) &&
        ctx.before().inMachineCoordinates(tool) && !(event.axes >> unsigned(tool) & 1))
      return false;
    if (namesAxesAlone(ctx.dialect(), ctx.block()) ||
        ctx.find({Action::LengthPositive, Action::LengthNegative}))
      return false; // (a tool comes to its first height with its length)
    if (comesBackFromBeyond(event, ctx))
      return false;
    // Along the tool's axis to a place that is not known, perhaps out of the work.
    const Interval &from = ctx.before().at(tool), &to = ctx.after().at(tool);
    if (!ctx.dialect().isLathe() && event.axes == uint16_t(1u << unsigned(tool)) &&
        !to.isConstant() && !(to.hi < from.lo))
      return false;
    // No motion was asked for, and none is made for want of a feed: other rules say so.
    const GroupIndex motion = ctx.dialect().group(StandardGroup::Motion);
    return motion == noGroup || ctx.after().mayBeStated(motion) || ctx.after().may(Fact::FeedSet);
  }

  /// A lathe: the way that a parting tool has come, from beyond the axis outwards.
  static bool comesBackFromBeyond(const Event &event, const RuleContext &ctx) {
    const Interval &from = ctx.before().at(Axis::X), &to = ctx.after().at(Axis::X);
    return ctx.dialect().isLathe() && event.axes == uint16_t(1u << unsigned(Axis::X)) &&
           from.isConstant() && to.isConstant() && from.value() < 0 && to.value() > from.value();
  }

  /// The machine profile says where the stock ends, and the whole move is above it.
  bool isAboveStock(const RuleContext &ctx) const {
    const Interval &from = ctx.before().at(Axis::Z), &to = ctx.after().at(Axis::Z);
    return top_ && !ctx.dialect().isLathe() && from.lo > *top_ && to.lo > *top_ &&
           !ctx.before().inMachineCoordinates(Axis::Z) &&
           !ctx.after().inMachineCoordinates(Axis::Z);
  }

  /// Whether one of the next blocks starts the spindle, before a cycle, another tool, or a move of
  /// these axes.
  static bool startsAhead(const RuleContext &ctx, unsigned furthest, uint16_t axes) {
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
      if (findCode(ctx.dialect(), next, {Action::SpindleCw, Action::SpindleCcw}))
        return true;
      if (axesOf(ctx.dialect(), next) & axes ||
          findCode(ctx.dialect(), next, {Action::Cycle, Action::ToolChange}))
        return false;
    }
    return false;
  }

  /// A mill: across to the first cut of the tool, at the height to which it came at rapid; the
  /// spindle is started before it goes down.
  static bool isInAir(const Event &event, const RuleContext &ctx) {
    constexpr unsigned furthest = 6; // blocks
    const Axis tool = toolAxis(ctx.dialect(), ctx.after());
    const MachineState &before = ctx.before();
    const Interval &height = before.at(tool);
    if (ctx.dialect().isLathe() || event.axes >> unsigned(tool) & 1 ||
        before.may(Fact::CutSinceTool) || (height.isConstant() && height.value() < 0))
      return false;
    return startsAhead(ctx, furthest, uint16_t(1u << unsigned(tool)));
  }

  /// The cycle cuts with the spindle; without axis words a modal cycle sets modes only.
  static bool runs(const Event &event, const CodeInfo &code, const RuleContext &ctx) {
    return code.spindle != SpindleNeed::Any && code.spindle != SpindleNeed::StartsItself &&
           (event.axes || code.group == noGroup || code.firesOnEveryBlock ||
            ctx.code(event).cycle == CycleKind::Pattern);
  }

  static bool mayTurn(uint8_t spindle, uint8_t live) {
    constexpr uint8_t turning = spindleCw | spindleCcw;
    return (spindle & turning) || (live & turning);
  }
  /// Spindle and live tool may both be stopped. After a code of the machine's builder either may be
  /// doing anything.
  static bool mayStop(uint8_t spindle, uint8_t live) {
    constexpr uint8_t stopped = spindleOff | spindleOriented;
    return (spindle & stopped) && (live & stopped) && spindle != spindleAny && live != spindleAny;
  }

  /// The program has said nothing of tool, speed and spindle.
  static bool nothingSaid(const MachineState &state) {
    return !state.may(Fact::ToolCalled) && !state.may(Fact::SpeedSet) &&
           !state.may(Fact::SpindleStated);
  }

  /// Neither speed nor spindle: the program may run axes in, guide a laser, or leave the spindle to
  /// a switch of its own.
  static std::optional<Severity> severityOf(const MachineState &state, bool byHand,
                                            const RuleContext &ctx) {
    // A pen is put down by such a program, after an M05 for safety.
    if (byHand || (state.may(Fact::SpindleStated) && !state.may(Fact::ToolCalled) &&
                   !state.may(Fact::SpeedSet) && namesNoSpindle(ctx)))
      return Severity::Style;
    return neverTurns(state, ctx) ? std::optional(Severity::Warning) : std::nullopt;
  }

  /// Up to here neither speed nor spindle was named, and no block of the program starts a spindle.
  static bool neverTurns(const MachineState &state, const RuleContext &ctx) {
    return nothingSaid(state) ||
           (!state.may(Fact::SpeedSet) && !state.may(Fact::SpindleStated) && startsNoSpindle(ctx));
  }

  /// A bar puller or a gripper: the spindle was stopped before its tool was called, or it goes to
  /// the bar by feed per minute, and the next thing that the program does is a code of the chuck or
  /// of the machine's builder.
  static bool isForHandling(const MachineState &state, const RuleContext &ctx) {
    constexpr unsigned furthest = 6; // blocks
    const Origin &stop = state.origin.of(StatePart::Spindle);
    const Origin &tool = state.origin.of(StatePart::Tool);
    const bool perMinute = (ctx.dialect().isLathe() || turnsWork(ctx.dialect(), state)) &&
                           state.isActive(ctx.dialect(), StandardGroup::FeedMode,
                                          {Action::FeedPerMinute}) == Truth::Yes;
    const bool calledAfter = tool.known() && stop.file == tool.file && tool.begin >= stop.begin;
    if (!stop.known() || (!calledAfter && !perMinute))
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next) && !next.has(letterAddress('T')); ++i)
      for (const Word &word : next.words) {
        if (word.address != letterAddress('M'))
          continue;
        const CodeIndex code = codeOf(ctx.dialect(), word);
        return code == noCode || isOfChuck(ctx.dialect().codes[code].action);
      }
    return false;
  }

  /// A bar for back boring goes through the bore with its edge turned aside, and starts there.
  static bool isBackBoring(const MachineState &state, const RuleContext &ctx) {
    constexpr unsigned furthest = 8; // blocks
    if (state.spindle != spindleOriented)
      return false;
    return startsAhead(ctx, furthest, 0);
  }

  /// Between the tool and the cut the program stops: the spindle may be one that is switched by
  /// hand.
  static bool stopsForHand(const RuleContext &ctx) {
    constexpr unsigned furthest = 200; // blocks
    BlocksBefore before(ctx);
    Block block;
    for (unsigned i = 0; i < furthest && before.next(block); ++i) {
      if (findCode(ctx.dialect(), block, {Action::ProgramStop}))
        return true;
      if (findCode(ctx.dialect(), block, {Action::ToolChange, Action::Cycle, Action::Linear}))
        return false;
    }
    return false;
  }

  /// `S2000 M43`: since the stop a code that only the builder knows was given with a speed.
  static bool isStartedByBuilder(const Origin &stop, const RuleContext &ctx) {
    constexpr unsigned furthest = 60; // blocks
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < furthest; ++i, more = readBack(ctx, block)) {
      if (isHere(ctx, stop) && block.begin <= stop.begin)
        return false;
      if (block.has(letterAddress('S')) && llvm::any_of(block.words, [&](const Word &word) {
            return word.address == letterAddress('M') && codeOf(ctx.dialect(), word) == noCode;
          }))
        return true;
    }
    return false;
  }

  static bool isOfChuck(Action action) {
    return action == Action::MachineSpecific || action == Action::ChuckOpen ||
           action == Action::ChuckClose;
  }

  /// A hole that the block of the stop itself makes.
  static void holeOfStop(const Event &event, const CodeInfo &code, FindingBuilder &finding,
                         const RuleContext &ctx) {
    if (!ctx.dialect().emptyBlocksRun || ctx.codeWord(event) || !ctx.find({Action::SpindleStop}))
      return;
    finding.severity(Severity::Error)
        .note(ctx.before().origin.of(StatePart::Cycle),
              code.name + " becomes active here, and runs in every block")
        .fix(FixSafety::Unsafe, "end the cycle before this block",
             ctx.insertBlockBefore(cancelOf(ctx.dialect(), code)));
  }

  /// A text with neither the word that opens a program nor one that ends it.
  static bool isFragment(const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block :
         blocksNaming(ctx.index(), program, ctx.dialect(),
                      {Action::ProgramHead, Action::ProgramEnd, Action::ProgramEndRewind}))
      if (findCode(ctx.dialect(), block,
                   {Action::ProgramHead, Action::ProgramEnd, Action::ProgramEndRewind}))
        return false;
    return true;
  }

  MeasuringTools measuring_;
  bool anyMachine_ = false; ///< a program that names no spindle at all may be for a machine without
  unsigned otherMaster_ = 0;     ///< switch that says that another spindle is the master
  bool masterFeeds_ = false;     ///< feed per revolution is that of the master spindle
  bool startWhereNamed_ = false; ///< a program that never wants a spindle is for one with a switch
  bool builderStarts_ = false;   ///< a program that starts no spindle has it started by other codes
  std::optional<double> top_;    ///< of the stock
  bool hasHead_ = false;         ///< the control has a word that opens a program
};

} // namespace
NCVET_RULE(SpindleOffWhileCutting, spindle_off_while_cutting)
} // namespace ncvet
