// A rapid move along the tool axis leads into the work.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/next_station.h"
#include "analyzer/facts/turned_pass.h"
#include "analyzer/facts/turning_rapids.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/report_once.h"
#include "formats/text/number_text.h"
#include "interp/geometry/obstacle.h"

namespace ncvet {
namespace {

struct MotionRapidPlungeMemory {
  /// Rapid moves in the air have an F too: some post-processors write one into every block.
  bool feedsRapids = false;
  OncePerCause allRapid; ///< no block of the program is fed
};

class MotionRapidPlunge final : public StatefulRule<MotionRapidPlungeMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::Rapid});
    lathe_ = to.dialect().isLathe();
    const MachineProfile &machine = to.machine();
    top_ = machine.stock && machine.stock->max[2] ? machine.stock->max[2]
                                                  : machine.number("stockTopZ");
    wanted_ = to.flag("belowZero");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    constexpr auto tool = uint16_t(1u << unsigned(Axis::Z));
    if (ctx.block().has(letterAddress('F')) && withoutCode(event, ctx))
      return;
    const bool turns = lathe_ || isTurning(ctx);
    if (turns)
      turning_.intoWork(event, places_, ctx);
    if (lathe_) {
      if (ctx.after().at(Axis::X).hi <= 0) // beside the work it does no harm
        leavesDeep(event, ctx);
      TurningRapids::towardsChuck(event, ctx);
      return TurningRapids::alongWork(event, memory().feedsRapids, ctx);
    }
    if (turns)
      return;
    const Interval &from = ctx.before().at(Axis::Z), &to = ctx.after().at(Axis::Z);
    if (isRapidWithFeed(ctx) && !endsLowerBelowZero(ctx))
      memory().feedsRapids = true;
    alongOther(event, ctx);
    belowOthers(event, ctx);
    if (acrossWithFeed(event, ctx) ||
        (!from.isConstant() && (forNothing(event, ctx) || leavesDeep(event, ctx))))
      return;
    if (!(event.axes & tool) || event.inMachineCoordinates() || !from.isConstant() ||
        !to.isConstant() || ctx.before().inMachineCoordinates(Axis::Z) ||
        ctx.after().inMachineCoordinates(Axis::Z) || to.value() >= from.value() ||
        ctx.before().may(Fact::UnknownCode) || ctx.after().may(Fact::UnknownCode) ||
        takesWordsItself(ctx) || mayBeTransformed(ctx.dialect(), ctx.after()) ||
        turnsWork(ctx.dialect(), ctx.after()))
      return;
    if (intoClamp(event, ctx) || outOfCut(event, ctx) || withFeed(event, ctx) ||
        beforeHome(event, ctx) || forNothing(event, ctx) || slanting(event, ctx) ||
        leavesDeep(event, ctx))
      return;
    // With a stock it is the end that counts, wherever the tool comes from.
    if (!top_ && (!wanted_ || event.axes != tool))
      return;
    const double top = top_.value_or(0);
    if (to.value() >= top || from.value() < top || besideStock(ctx))
      return;
    if (!top_ && (!cutsAcross(ctx) || isFedOnDown(ctx)))
      return;
    if (auto finding = ctx.report(event, top_.has_value()))
      finding.message("this rapid move ends {0} below {1}: the tool goes into the work at full "
                      "speed",
                      shortLength(ctx, top - to.value()), top_ ? "the top of the stock" : "zero");
  }

private:
  /// A tool along another axis than Z goes at rapid to where the stock is.
  static void alongOther(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Axis tool = toolAxis(ctx.dialect(), after);
    const auto axis = unsigned(tool);
    if (tool == Axis::Z || axis > 2 || !ctx.machine().stock || !(event.axes >> axis & 1) ||
        event.inMachineCoordinates() || !after.frames.empty() || before.machineAxes ||
        after.machineAxes || before.may(Fact::UnknownCode) || after.may(Fact::UnknownCode) ||
        takesWordsItself(ctx) || mayBeTransformed(ctx.dialect(), after))
      return;
    const Stock &stock = *ctx.machine().stock;
    const Interval &from = before.at(tool), &to = after.at(tool);
    if (!stock.max[axis] || !from.isConstant() || !to.isConstant() ||
        from.value() < *stock.max[axis] || to.value() >= *stock.max[axis])
      return;
    for (unsigned i = 0; i < 3; ++i) {
      const Interval &at = after.position[i];
      if (!at.isConstant() || (stock.min[i] && at.value() < *stock.min[i]) ||
          (stock.max[i] && at.value() > *stock.max[i]))
        return;
    }
    if (auto finding = ctx.report(event, event.certain))
      finding.message("this rapid move ends {0} inside the stock, along the tool: it goes into "
                      "the work at full speed",
                      shortLength(ctx, *stock.max[axis] - to.value()));
  }

  /// A feed in a block that says no motion, while a rapid is in force; and the next one either has
  /// a feed too, or goes back to rapid moves, as if it had to: G01 is missing.
  bool withoutCode(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    if (!event.certain || ctx.block().has(letterAddress('G')) || memory().feedsRapids ||
        event.inMachineCoordinates() || before.may(Fact::UnknownCode) || before.modalCalls ||
        before.profile != ProfileMode::Off ||
        before.activeAction(ctx.dialect(), StandardGroup::Motion) != Action::Rapid ||
        !before.originOf(ctx.dialect(), StandardGroup::Motion).known() || !isFedOrRapid(event, ctx))
      return false;
    if (isNeverFed(event, ctx))
      return true;
    if (auto finding = ctx.report(event))
      finding
          .message("this move has a feed, and a rapid move is in force: the tool is not fed, it "
                   "goes at full speed")
          .note(before.originOf(ctx.dialect(), StandardGroup::Motion), "by this code");
    return true;
  }

  /// No block of the program has a code for a feed move, and many have a feed: said once.
  bool isNeverFed(const Event &event, RuleContext &ctx) const {
    constexpr unsigned many = 3; // blocks
    const unsigned fed = places_.of(ctx).neverFed;
    if (fed < many)
      return false;
    if (!memory().allRapid.speaks(Origin(), ctx))
      return true;
    if (auto finding = ctx.report(event))
      finding
          .message("no block of the program has a code for a feed move: this one and the others "
                   "with a feed, {0} blocks, run at rapid, and the tool goes in at full speed",
                   fed)
          .note(ctx.after().originOf(ctx.dialect(), StandardGroup::Motion), "by this code");
    return true;
  }

  /// Whether the next block moves by a feed of its own, or by a code for rapid moves.
  bool isFedOrRapid(const Event &event, const RuleContext &ctx) const {
    BlocksAhead ahead(ctx);
    Block next;
    if (!ahead.next(next) || !next.items.empty() || !namesAxes(ctx.dialect(), next))
      return false;
    if (!next.has(letterAddress('G')))
      return next.has(letterAddress('F'));
    // A mill may set its feed on the first way in the air.
    if (!lathe_ && !(event.axes >> unsigned(Axis::Z) & 1))
      return false;
    return !next.has(letterAddress('F')) && findCode(ctx.dialect(), next, {Action::Rapid}) &&
           !findCode(ctx.dialect(), next,
                     {Action::MachineMove, Action::ReferenceReturn, Action::Incremental});
  }

  /// A mill: down to below zero, and then home, to the next tool or to the end, with nothing done
  /// there: the retract has lost its other sign.
  static bool beforeHome(const Event &event, RuleContext &ctx) {
    const double from = ctx.before().at(Axis::Z).value(), to = ctx.after().at(Axis::Z).value();
    if (!event.certain || event.axes != 1u << unsigned(Axis::Z) || to >= 0 ||
        !ctx.before().may(Fact::CutSinceTool) || !ctx.after().frames.empty() ||
        nextStation(ctx) != Station::Home)
      return false;
    if (auto finding = ctx.report(event))
      finding.message("this rapid move goes {0} down to below zero, and the tool does nothing "
                      "there before it goes away: a retract has the other sign",
                      shortLength(ctx, from - to));
    return true;
  }

  /// A mill: down to below zero, and at once up again to above it: a sign is missing.
  static bool forNothing(const Event &event, RuleContext &ctx) {
    const Interval &to = ctx.after().at(Axis::Z);
    const Word *const here = ctx.block().find(letterAddress('Z'));
    if (!(event.axes >> unsigned(Axis::Z) & 1) || !to.isConstant() || to.value() >= 0 || !here ||
        !event.certain || event.inMachineCoordinates() || !ctx.after().frames.empty() ||
        ctx.after().inMachineCoordinates(Axis::Z) || ctx.before().may(Fact::UnknownCode) ||
        turnsWork(ctx.dialect(), ctx.after()) || takesWordsItself(ctx) ||
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
            Truth::No ||
        !(comesUpNext(ctx) || (hasCutAcross(ctx) && risesNext(ctx)) ||
          (!ctx.before().may(Fact::CutSinceTool) && isFedUpNext(ctx))))
      return false;
    if (auto finding = ctx.report(event))
      finding.message("this rapid move goes down to {0} below zero, and the tool comes up again "
                      "with nothing done there: its Z has the other sign",
                      shortLength(ctx, -to.value()));
    return true;
  }

  /// A mill: from above zero down and across at once, to where it cuts on; all other ways down to
  /// there are fed, along Z alone.
  bool slanting(const Event &event, RuleContext &ctx) const {
    constexpr unsigned habit = 2; // ways
    const Word *const z = ctx.block().find(letterAddress('Z'));
    if (top_ || !event.certain || !z || !z->isNumber() || z->value() >= 0 ||
        ctx.before().at(Axis::Z).value() < 0 || event.axes == 1u << unsigned(Axis::Z) ||
        !cutsOnAcross(ctx))
      return false;
    const PlacesAlong &places = places_.of(ctx);
    const auto ways = places.below.find(z->value());
    if (ways == places.below.end() || ways->second.rapid != 1 || ways->second.fed < habit)
      return false;
    if (auto finding = ctx.report(event))
      finding.message(
          "this rapid move leads down and across to {0} below zero, where the tool cuts "
          "on: elsewhere the program feeds it down to there",
          shortLength(ctx, -ctx.after().at(Axis::Z).value()));
    return true;
  }

  /// `G43 H3 Z-50.` where the other tools come down to above zero: the sign is missing there.
  void belowOthers(const Event &event, RuleContext &ctx) const {
    const Interval &to = ctx.after().at(Axis::Z);
    if (!(event.axes >> unsigned(Axis::Z) & 1) || !to.isConstant() || to.value() >= 0 ||
        !event.certain || event.inMachineCoordinates() || !ctx.after().frames.empty() ||
        ctx.before().may(Fact::UnknownCode) || ctx.callDepth() > 0)
      return;
    if (!comesWithLength(ctx.dialect(), ctx.block()))
      return;
    if (!othersComeAbove(ctx)) {
      if (isBelowAll(ctx, 2))
        deeperThanAll(event, ctx);
      return;
    }
    if (auto finding = ctx.report(event))
      finding.message("the tool comes down at rapid to {0} below zero, and all others of the "
                      "program to above it",
                      shortLength(ctx, -to.value()));
  }

  static void deeperThanAll(const Event &event, RuleContext &ctx) {
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("this rapid move ends {0} below zero, which is deeper than anything that the "
                   "program cuts",
                   shortLength(ctx, -ctx.after().at(Axis::Z).value()));
  }

  /// After a cut along Z alone to below everything, and nothing is cut there.
  bool leavesDeep(const Event &event, RuleContext &ctx) const {
    const Word *const z = ctx.block().find(letterAddress('Z'));
    const MachineState &after = ctx.after();
    if (event.axes != 1u << unsigned(Axis::Z) || !z || !z->isNumber() || z->value() >= 0 ||
        !event.certain || event.inMachineCoordinates() || !after.frames.empty() ||
        ctx.before().may(Fact::UnknownCode) || ctx.callDepth() > 0 ||
        !ctx.before().must(Fact::CutSinceTool) || takesWordsItself(ctx) ||
        after.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) ==
            Truth::Yes ||
        !isBelowAll(ctx, 1) || !doesNothingHere(ctx))
      return false;
    deeperThanAll(event, ctx);
    return true;
  }

  /// At a depth, in the plane, by a code for rapid moves and with a feed, and no other block of the
  /// program has both: G01 was meant.
  bool acrossWithFeed(const Event &event, RuleContext &ctx) const {
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    const Interval &at = ctx.after().at(Axis::Z);
    if (!isRapidWithFeed(ctx) || event.axes & ~plane || !event.certain || !at.isConstant() ||
        at.value() >= 0 || event.inMachineCoordinates() || !ctx.after().frames.empty() ||
        ctx.after().inMachineCoordinates(Axis::Z) || ctx.before().may(Fact::UnknownCode) ||
        turnsWork(ctx.dialect(), ctx.after()) || takesWordsItself(ctx) || ctx.callDepth() > 0 ||
        places_.of(ctx).fedRapids != 1)
      return false;
    if (auto finding = ctx.report(event))
      finding.message(
          "this rapid move at {0} below zero has a feed, as no other of the program: the "
          "tool is not fed, it goes through at full speed",
          shortLength(ctx, -at.value()));
    return true;
  }

  /// The block puts a length in force, and says how low the tool goes with it.
  static bool comesWithLength(const Dialect &dialect, const Block &block) {
    const Word *const z = block.find(letterAddress('Z'));
    return z && z->isNumber() && findCode(dialect, block, {Action::LengthPositive}) &&
           !findCode(dialect, block, {Action::Incremental, Action::Linear, Action::MachineMove});
  }

  /// The place of the block along Z is so many times as deep as all others of the program.
  bool isBelowAll(const RuleContext &ctx, double times) const {
    const auto &[first, second] = places_.of(ctx).lowest;
    const double here = ctx.block().find(letterAddress('Z'))->value();
    return here <= first && second < 0 && here < times * second;
  }

  /// At least two tools of the program come to above zero with their length, and but this one none
  /// to below.
  static bool othersComeAbove(const RuleContext &ctx) {
    constexpr unsigned habit = 2; // tools
    unsigned above = 0, below = 0;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block :
         blocksNaming(ctx.index(), program, ctx.dialect(), {Action::LengthPositive}))
      if (comesWithLength(ctx.dialect(), block))
        ++(block.find(letterAddress('Z'))->value() > 0 ? above : below);
    return above >= habit && below == 1;
  }

  /// The path down leads through a clamp.
  static bool intoClamp(const Event &event, RuleContext &ctx) {
    if (!ctx.after().frames.empty() || ctx.before().machineAxes || ctx.after().machineAxes ||
        llvm::none_of(ctx.machine().clamps, [&](const Stock &clamp) {
          return leadsThrough(clamp, ctx.before().position, ctx.after().position) == Truth::Yes;
        }))
      return false;
    if (auto finding = ctx.report(event))
      finding.message("this rapid move leads down into a clamp of the machine profile");
    return true;
  }

  /// The tool has just cut at a level to which it was fed down, and goes further down at rapid; the
  /// same number with the other sign would be the retract.
  static bool outOfCut(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const Interval &fed = before.fedFrom.get();
    const double from = before.at(Axis::Z).value(), to = ctx.after().at(Axis::Z).value();
    // Beside the part the tool may have come down at rapid: what tells then is that it leaves.
    const Interval level =
        fed.isConstant() || !leavesAtRapid(from, to, ctx) ? fed : Interval::exactly(0);
    const Word *const word = ctx.block().find(letterAddress('Z'));
    if (word && !word->isNumber()) // what is computed has no sign to lose
      return false;
    if (!event.certain || !level.isConstant() || from >= level.value() ||
        before.may(Fact::AwayFromPart) || !before.must(Fact::CutSinceTool))
      return false;
    const Truth incremental =
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental});
    const double mirrored = incremental == Truth::Yes ? from + (from - to) : -to;
    if (incremental == Truth::Unknown || mirrored < level.value() || isFedOnDown(ctx))
      return false;
    if (auto finding = ctx.report(event))
      finding.message("this rapid move goes {0} further down out of the cut: a retract has the "
                      "other sign",
                      shortLength(ctx, from - to));
    return true;
  }

  /// Far down from below zero, and on at rapid in the plane.
  static bool leavesAtRapid(double from, double to, const RuleContext &ctx) {
    constexpr double far = 10; // mm
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    if (from >= 0 || from - to < far)
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    return ahead.next(next) && (axesOf(ctx.dialect(), next) & plane) &&
           (findCode(ctx.dialect(), next, {Action::Rapid}) || !hasMotionCode(ctx.dialect(), next));
  }

  /// The next block feeds the tool along its axis: the rapid move went down a groove that is cut.
  static bool isFedOnDown(const RuleContext &ctx) {
    BlocksAhead ahead(ctx);
    Block next;
    return ahead.next(next) && findCode(ctx.dialect(), next, {Action::Linear}) &&
           (axesOf(ctx.dialect(), next) >> unsigned(Axis::Z) & 1);
  }

  /// Down below zero at rapid, with a feed in the block or in the move after it: G1 was meant. With
  /// the feed in its own block a move that begins below zero counts too.
  bool withFeed(const Event &event, RuleContext &ctx) const {
    const bool here = ctx.block().has(letterAddress('F'));
    if (!event.certain ||
        !(isRapidWithFeed(ctx) ? endsLowerBelowZero(ctx) : leadsDownBelowZero(ctx)))
      return false;
    // Another G code may take the words, whatever the table knows of it.
    if (ctx.block().has(letterAddress('G')) && !ctx.find({Action::Rapid}))
      return false;
    if (isRapidWithFeed(ctx) ? memory().feedsRapids : !here && !nextMoveIsFed(ctx))
      return false;
    if (isNeverFed(event, ctx))
      return true;
    if (auto finding = ctx.report(event))
      finding.message("this rapid move ends {0} below zero, and {1} has a feed: the tool is not "
                      "fed, it goes in at full speed",
                      shortLength(ctx, -ctx.after().at(Axis::Z).value()),
                      here ? "its block" : "the next move");
    return true;
  }

  /// The block names both a rapid move and a feed.
  static bool isRapidWithFeed(const RuleContext &ctx) {
    return ctx.block().has(letterAddress('F')) && ctx.find({Action::Rapid});
  }

  static bool endsLowerBelowZero(const RuleContext &ctx) {
    const Interval &from = ctx.before().at(Axis::Z), &to = ctx.after().at(Axis::Z);
    return from.isConstant() && to.isConstant() && to.value() < from.value() && to.value() < 0;
  }

  static bool leadsDownBelowZero(const RuleContext &ctx) {
    return endsLowerBelowZero(ctx) && ctx.before().at(Axis::Z).value() >= 0;
  }

  /// The next block moves in the plane, still at rapid, and has a feed.
  static bool nextMoveIsFed(const RuleContext &ctx) {
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    BlocksAhead ahead(ctx);
    Block next;
    return ahead.next(next) && (axesOf(ctx.dialect(), next) & plane) &&
           next.has(letterAddress('F')) && !hasMotionCode(ctx.dialect(), next) &&
           !findCode(ctx.dialect(), next, {Action::SkipMove});
  }

  /// The tool comes down where the stock certainly is not.
  static bool besideStock(const RuleContext &ctx) {
    if (!ctx.machine().stock || !ctx.after().frames.empty())
      return false;
    const Stock &stock = *ctx.machine().stock;
    for (size_t i = 0; i < 2; ++i) {
      const Interval &at = ctx.after().position[i];
      if ((stock.min[i] && at.hi <= *stock.min[i]) || (stock.max[i] && at.lo >= *stock.max[i]))
        return true;
    }
    return false;
  }

  TurningRapids turning_;
  PlacesOfPrograms places_;
  std::optional<double> top_;
  bool wanted_ = false;
  bool lathe_ = false;
};

} // namespace
NCVET_RULE(MotionRapidPlunge, motion_rapid_plunge)
} // namespace ncvet
