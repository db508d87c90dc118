// A compensation code without a move in the plane, and a subprogram that begins without one.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class CompensationWithoutMotion final : public Rule {
public:
  void listen(Subscriptions &to) override {
    cancelAlone_ = to.dialect().facts->compensation.cancelAlone;
    anyPlane_ = to.dialect().facts->compensation.planeOfBuilder;
    feeds_ = to.dialect().facts->compensation.entryByFeed;
    if (feeds_)
      to.onChange({EventKind::Motion});
    if (to.flag("calledStartsWithMove"))
      to.onChange({EventKind::Block});
    to.onAction({Action::CompensationLeft, Action::CompensationRight, Action::CompensationOff});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion)
      firstMove(event, ctx);
    else if (event.kind == EventKind::Block)
      atSubprogramStart(ctx);
    else
      atCode(event, ctx);
  }

private:
  /// Directly before the finishing cycle of a lathe, which cuts the contour with it, or after it.
  static bool isForFinish(const RuleContext &ctx) {
    // The cycle may be what a code is under a condition: `G70` with P and Q.
    const auto finishes = [&](const Block &block) {
      return block.hasAny(maskOf('P') | maskOf('Q')) &&
             findReading(ctx.dialect(), block,
                         [](const CodeInfo &code) { return code.cycle == CycleKind::Finish; });
    };
    Block block;
    if (!ctx.dialect().isLathe())
      return false;
    if (readPrevious(ctx, block) && finishes(block))
      return true;
    BlocksAhead ahead(ctx);
    return ahead.next(block) && finishes(block);
  }

  /// The first piece of the contour is made at feed.
  void firstMove(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    if (event.motion != MotionKind::Rapid || before.compensation != phaseOn ||
        ctx.after().compensation != phaseOn || before.may(Fact::CompensatedCut) ||
        !(event.axes & planeAxes(ctx.dialect(), ctx.after())) || before.may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("the first piece of the contour under {0} is a rapid move: it is made at feed",
                   compensationName(ctx.dialect(), ctx.before()))
          .note(before.origin.of(StatePart::Compensation), "compensation is switched on here");
  }

  /// The block makes the last piece of a closed contour: at feed, to the point that the block gives
  /// which has switched compensation on.
  static bool closesContour(RuleContext &ctx) {
    const Origin &on = ctx.before().origin.of(StatePart::Compensation);
    const CodeInfo *motion = ctx.after().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (!motion || motion->action != Action::Linear || !on.known() ||
        !ctx.before().frames.empty() ||
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Absolute}) !=
            Truth::Yes)
      return false;
    Block first;
    readBlockOf(ctx, on, first);
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    uint16_t same = 0, moved = 0;
    for (const Word &word : first.words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if (address.kind != AddressKind::Axis || !(plane >> unsigned(address.axis) & 1) ||
          !word.isNumber())
        continue;
      const Interval &from = ctx.before().at(address.axis), &to = ctx.after().at(address.axis);
      if (!from.isConstant() || !to.isConstant() || to.value() != word.value())
        return false;
      same |= uint16_t(1u << unsigned(address.axis));
      if (from.value() != to.value())
        moved |= same;
    }
    return same == plane && moved;
  }

  /// The code that ends it goes on along the last piece: only a block of its own leaves the
  /// contour.
  void onLastPiece(const Event &event, RuleContext &ctx) const {
    // A recorded section may leave straight on.
    if (!feeds_ || ctx.before().compensation != phaseOn ||
        ctx.before().profile == ProfileMode::Recorded || !ctx.before().must(Fact::CompensatedCut))
      return;
    if (closesContour(ctx)) {
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message("`{0}` leads back to the first point of the contour: the last piece is cut "
                     "while compensation is taken away",
                     ctx.code(event).name)
            .note(ctx.before().origin.of(StatePart::Compensation), "the contour begins here");
      return;
    }
    Block last;
    if (!readPrevious(ctx, last))
      return;
    // The piece before and this one run along the same axis, the same way.
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    const CodeInfo *motion = ctx.after().activeCode(ctx.dialect(), StandardGroup::Motion);
    const uint16_t axes = axesOf(ctx.dialect(), last) & plane;
    if (!motion || motion->action != Action::Linear || (axes & (axes - 1)) || !axes ||
        findCode(ctx.dialect(), last, {Action::ArcCw, Action::ArcCcw, Action::Rapid}))
      return;
    uint16_t moved = 0;
    for (unsigned i = 0; i < axisCount; ++i) {
      const Interval &from = ctx.before().position[i], &to = ctx.after().position[i];
      if (!(plane >> i & 1))
        continue;
      if (!from.isConstant() || !to.isConstant())
        return;
      if (from.value() != to.value())
        moved |= uint16_t(1u << i);
    }
    if (moved != axes)
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` is in a block that goes on along the contour: compensation ends "
                   "while the last piece is cut",
                   ctx.code(event).name);
  }

  bool feeds_ = false;       ///< the contour begins at feed, and ends before the retract
  bool cancelAlone_ = false; ///< the control wants its G40 without a move
  bool anyPlane_ = false;    ///< the machine's builder decides which plane holds at power-on

  bool movesInPlane(RuleContext &ctx) const {
    // No plane was stated: it may be any.
    constexpr uint16_t space =
        1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y) | 1u << unsigned(Axis::Z);
    const bool stated =
        !anyPlane_ || ctx.after().active(ctx.dialect(), StandardGroup::Plane) != groupUnset;
    const uint16_t plane = stated ? planeAxes(ctx.dialect(), ctx.after()) : space;
    // Where it is not known whether a cycle is active, the block may as well be a hole of it.
    return llvm::any_of(ctx.outcome().events, [&](const Event &e) {
      return (e.kind == EventKind::Motion || (e.kind == EventKind::CycleRun && e.code == noCode)) &&
             (e.axes & plane);
    });
  }

  /// The block after this one gives coordinates in the plane, and no code of its own.
  static bool nextMovesInPlane(RuleContext &ctx) {
    BlocksAhead ahead(ctx);
    Block next;
    return ahead.next(next) &&
           (axesOf(ctx.dialect(), next) & planeAxes(ctx.dialect(), ctx.after())) &&
           !findCode(
               ctx.dialect(), next,
               {Action::CompensationLeft, Action::CompensationRight, Action::CompensationOff});
  }

  static bool nextIsArc(RuleContext &ctx) {
    BlocksAhead ahead(ctx);
    Block next;
    return ahead.next(next) &&
           findCode(ctx.dialect(), next,
                    {Action::ArcCw, Action::ArcCcw, Action::CurveThrough, Action::CurveTangent});
  }

  void atCode(const Event &event, RuleContext &ctx) const {
    if (isForFinish(ctx))
      return;
    const CodeInfo &code = ctx.code(event);
    const bool off = code.action == Action::CompensationOff;
    if (off)
      onLastPiece(event, ctx);
    if (off && cancelAlone_)
      return;
    const uint8_t before = ctx.before().compensation, after = ctx.after().compensation;
    const uint8_t waiting = off ? phaseEnding : phaseStarting;
    if (!(after & waiting) || (off ? !(before & phaseOn) : (before & phaseOn)) || movesInPlane(ctx))
      return;
    // `G47 K`: it begins at the foot of the normal to the next element. `G46 K`: where it leads to
    // may be in the next block.
    if (llvm::any_of(ctx.block().words,
                     [&](const Word &w) {
                       return w.has(wordNoValue) && (code.takes & maskOf(w.address));
                     }) &&
        (!off || nextMovesInPlane(ctx)))
      return;
    // The end of a soft approach may be where the next block begins.
    if (!off && ctx.find({Action::SoftApproach}) && nextMovesInPlane(ctx))
      return;
    const bool certain = after == waiting && (off ? before == phaseOn : !(before & phaseOn));
    auto finding = ctx.report(event, certain);
    if (!finding)
      return;
    const bool alone = axesOf(ctx.dialect(), ctx.block()) == 0;
    // The code in a block of its own and a straight move in the next one: a habit, and no surprise.
    if (cancelAlone_ && alone && nextMovesInPlane(ctx) && !nextIsArc(ctx))
      finding.severity(Severity::Style);
    finding.message(
        "`{0}` has no move in the plane{1}: compensation is {2} by whichever move comes "
        "next",
        code.name, alone ? "" : " in its block", off ? "removed" : "built up");
  }

  /// Called under compensation, the program's first block has to move in the plane: the call is a
  /// block without a move already.
  void atSubprogramStart(RuleContext &ctx) const {
    if (ctx.callDepth() == 0 || ctx.before().compensation != phaseOn ||
        ctx.before().profile != ProfileMode::Off || ctx.before().idleBlocks == 0 ||
        movesInPlane(ctx))
      return;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block : blocks(ctx.index(), program.body, ctx.block().begin))
      if (!block.isEmpty())
        return; // another block comes before
    // Switched on in the caller, not in a previous pass of this program.
    const Origin &origin = ctx.before().origin.of(StatePart::Compensation);
    if (isIn(ctx, origin, program))
      return;
    if (auto finding = ctx.report(ctx.blockRange())) {
      const CodeInfo *code = ctx.before().activeCode(ctx.dialect(), StandardGroup::Compensation);
      finding
          .message("the subprogram is called under {0} and begins without a move in the plane: "
                   "the path is distorted",
                   code ? "`" + code->name + "`" : std::string("compensation"))
          .note(origin, "compensation is switched on here");
    }
  }
};

} // namespace
NCVET_RULE(CompensationWithoutMotion, compensation_without_motion)
} // namespace ncvet
