// Blocks without a move in the plane, and moves of zero length, inside a compensated contour.
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct CompensationIdleBlocksMemory {
  uint32_t afterInfeed = ~0u; ///< after the last block that was one
  unsigned inARow = 0;
  uint32_t afterApproach = ~0u; ///< the block to come if it follows an approach and idle blocks
};

class CompensationIdleBlocks final : public StatefulRule<CompensationIdleBlocksMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Block});
    to.onMoves({MotionKind::Rapid, MotionKind::Feed, MotionKind::Thread});
    allowed_ = unsigned(to.number("allowed", 1));
    zeroMoves_ = to.flag("zeroMoves", true);
    infeeds_ = to.dialect().facts->compensation.infeedMoves;
    inSpace_ = to.dialect().facts->compensation.onlyInPlane;
    allowedAfterApproach_ = to.dialect().facts->compensation.idleBlocksAfterApproach;
    severity_ = to.dialect().facts->compensation.mayPassIdleBlocks
                    ? std::optional(Severity::Warning)
                    : std::nullopt;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion) {
      if (ctx.before().compensation != phaseOn)
        return sleepInShape();
      zeroMove(event, ctx);
      if (inSpace_)
        inSpace(event, ctx);
    } else {
      if (allowedAfterApproach_)
        approach(ctx);
      if ((ctx.after().compensation != phaseOn || !ctx.after().idleBlocks) &&
          !allowedAfterApproach_ && !infeeds_)
        return sleepInShape();
      idle(ctx);
      if (infeeds_)
        infeed(ctx);
    }
  }

private:
  /// Moves of the infeed axis alone, one after the other: the path has no next corner to turn to.
  void infeed(RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const uint16_t axes = axesOf(ctx.dialect(), ctx.block());
    const bool alone = axes == uint16_t(1u << unsigned(toolAxis(ctx.dialect(), state))) &&
                       (state.compensation & (phaseOn | phaseStarting)) &&
                       state.profile != ProfileMode::Recorded;
    if (ctx.block().isEmpty())
      return; // a remark is no block of the path
    const bool starting = ctx.before().compensation == phaseStarting;
    const bool follows = (alone || starting) && followsOn(memory().afterInfeed, ctx);
    // Until the first move in the plane nothing in between makes a difference.
    if (follows && !axes && starting) {
      memory().afterInfeed = ctx.block().next;
      return;
    }
    memory().inARow = alone ? follows ? memory().inARow + 1 : 1 : 0;
    memory().afterInfeed = alone ? ctx.block().next : ~0u;
    const bool certain = state.compensation == phaseOn || state.compensation == phaseStarting;
    if (memory().inARow != infeeds_ + 1 || (!certain && state.may(Fact::UnknownCode)))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), certain))
      finding
          .message("{0} moves of the infeed axis alone in a row under {1}: the control loses the "
                   "contour",
                   memory().inARow, compensationName(ctx.dialect(), ctx.after()))
          .note(state.origin.of(StatePart::Compensation), "compensation is switched on here");
  }

  /// Whether only remarks and blank lines are between the place and the block.
  static bool followsOn(uint32_t at, const RuleContext &ctx) {
    constexpr unsigned most = 50; // lines
    Block block;
    for (unsigned i = 0; at < ctx.block().begin && i < most; ++i, at = block.next) {
      ctx.index().read(at, block);
      if (!block.isEmpty() || block.next <= at)
        return false;
    }
    return at == ctx.block().begin;
  }

  /// Keeps which block comes next as long as only idle ones follow a soft approach.
  void approach(RuleContext &ctx) const {
    if (ctx.block().isEmpty())
      return;
    const bool follows = followsOn(memory().afterApproach, ctx) && ctx.after().idleBlocks > 0;
    const bool begins = llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      return ctx.code(use).action == Action::SoftApproach;
    });
    memory().afterApproach = begins || follows ? ctx.block().next : ~0u;
  }

  void idle(RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const bool approached = memory().afterApproach == ctx.block().next;
    const unsigned allowed = approached ? allowedAfterApproach_ : allowed_;
    if (state.compensation != phaseOn || state.profile == ProfileMode::Recorded ||
        outlivesTool(state) || state.idleBlocks != allowed + 1 ||
        ctx.before().idleBlocks != allowed || ctx.outcome().flow.kind == FlowKind::End ||
        turns(ctx) || !contourGoesOn(ctx))
      return;
    if (approached) {
      if (auto finding = ctx.report(ctx.blockRange()))
        finding
            .message("{0} blocks without a move in the plane between the soft approach and the "
                     "contour: the control stops",
                     allowed + 1)
            .severity(Severity::Error)
            .note(state.origin.of(StatePart::Compensation), "compensation is switched on here");
      return;
    }
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message(allowed_ == 0 ? "a block without a move in the plane under {1}: whether the "
                                   "control looks past it for the next corner is not stated"
                                 : "{0} blocks in a row without a move in the plane under {1}: the "
                                   "control cannot compute the next corner and cuts into it",
                   allowed_ + 1, compensationName(ctx.dialect(), ctx.after()))
          .severity(severity_)
          .note(state.origin.of(StatePart::Compensation), "compensation is switched on here");
  }

  /// The block, or the one before it, turns a rotary axis: under a transformation that is the
  /// second axis of the plane.
  static bool turns(const RuleContext &ctx) {
    constexpr uint16_t rotary =
        1u << unsigned(Axis::A) | 1u << unsigned(Axis::B) | 1u << unsigned(Axis::C);
    Block before;
    return ctx.dialect().isLathe() &&
           ((axesOf(ctx.dialect(), ctx.block()) & rotary) ||
            (readPrevious(ctx, before) && (axesOf(ctx.dialect(), before) & rotary)));
  }

  /// Looks ahead as the control does: only a compensated move after the idle blocks is harmed.
  static bool contourGoesOn(RuleContext &ctx) {
    constexpr unsigned lookAhead = 12;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    for (const Block &block : blocks(ctx.index(), ctx.block().next, program.end, lookAhead)) {
      bool resets = false;
      for (const Word &word : block.words) {
        if (word.address != letterAddress('G') && word.address != letterAddress('M'))
          continue;
        const CodeIndex index = ctx.dialect().find(char('A' + word.address), word.codeNumber());
        if (index == noCode)
          continue;
        switch (ctx.dialect().codes[index].action) {
        case Action::CompensationOff:
        case Action::ProgramEnd:
        case Action::ProgramEndRewind:
        case Action::Return:
        case Action::ReferenceReturn:
        case Action::ToolChange:
          return false;
        case Action::MachineMove:
        case Action::DataInput:
          resets = true;
          break;
        default:
          break;
        }
      }
      if (axesOf(ctx.dialect(), block) & plane)
        return !resets;
    }
    return false;
  }

  void zeroMove(const Event &event, RuleContext &ctx) const {
    // A control that looks past blocks without a move looks past this one as well.
    if (allowed_ > 1 || (!zeroMoves_ && !ctx.asked()) || ctx.before().compensation != phaseOn ||
        ctx.after().compensation != phaseOn || outlivesTool(ctx.after()) ||
        !ctx.block().issues.empty())
      return;
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    if (!(event.axes & plane) || event.inMachineCoordinates() || event.code == noCode ||
        ctx.after().profile == ProfileMode::Recorded ||
        (ctx.outcome().kinds & bitOf(EventKind::CoordinateChange)))
      return;
    for (unsigned i = 0; i < axisCount; ++i) {
      if (!(plane >> i & 1))
        continue;
      const Interval &from = ctx.before().position[i], &to = ctx.after().position[i];
      const bool frames = (ctx.before().machineAxes | ctx.after().machineAxes) >> i & 1;
      if (!from.isConstant() || !(from == to) || (frames && (event.axes >> i & 1)))
        return;
    }
    if (auto finding =
            ctx.report(ctx.blockRange(), zeroMoves_ && !ctx.before().may(Fact::UnknownCode)))
      finding
          .message("a move of zero length in the plane under {0}: the control sets the tool square "
                   "to the last element and cuts into the next",
                   compensationName(ctx.dialect(), ctx.after()))
          .note(ctx.after().origin.of(StatePart::Compensation), "compensation is switched on here");
  }

  /// A move that leaves the plane while it goes on along the contour.
  static void inSpace(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &state = ctx.after();
    const uint16_t plane = planeAxes(ctx.dialect(), state);
    constexpr uint16_t space = 7; // X, Y and Z
    uint16_t leaves = uint16_t(event.axes & space & ~plane);
    for (unsigned i = 0; i < axisCount; ++i)
      if (leaves >> i & 1 && before.position[i].isConstant() &&
          before.position[i] == state.position[i])
        leaves &= uint16_t(~(1u << i)); // it stays where it is
    if (before.compensation != phaseOn || state.compensation != phaseOn ||
        state.profile == ProfileMode::Recorded || !(event.axes & plane) || !leaves ||
        event.motion == MotionKind::Rapid || event.code == noCode)
      return;
    if (auto finding = ctx.report(ctx.blockRange(), !before.may(Fact::UnknownCode)))
      finding.severity(Severity::Warning)
          .message("the move leaves the plane under {0}: how the control compensates it is not "
                   "stated",
                   compensationName(ctx.dialect(), ctx.after()))
          .note(state.origin.of(StatePart::Compensation), "compensation is switched on here");
  }

  std::optional<Severity> severity_; ///< of blocks that the control perhaps looks past
  unsigned allowed_ = 1;
  bool zeroMoves_ = true;             ///< the manual says what a move of zero length does
  unsigned infeeds_ = 0;              ///< moves of the infeed axis alone that may follow each other
  bool inSpace_ = false;              ///< moves that leave the plane are reported
  unsigned allowedAfterApproach_ = 0; ///< 0: as elsewhere
};

} // namespace
NCVET_RULE(CompensationIdleBlocks, compensation_idle_blocks)
} // namespace ncvet
