// A compensation code without a move in the plane, and a subprogram that begins without one.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CompensationWithoutMotion final : public Rule {
public:
  void listen(Subscriptions &to) override {
    cancelAlone_ = to.option("cancelAlone", 0) != 0;
    anyPlane_ = to.option("anyPlane", 0) != 0;
    to.onChange({EventKind::Block});
    to.onAction({Action::CompensationLeft, Action::CompensationRight, Action::CompensationOff});
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Block)
      atSubprogramStart(ctx);
    else
      atCode(event, ctx);
  }

private:
  bool cancelAlone_ = false; ///< the control wants its G40 without a move
  bool anyPlane_ = false;    ///< the machine's builder decides which plane holds at power-on

  bool movesInPlane(RuleContext &ctx) const {
    // No plane was stated: it may be any.
    constexpr uint16_t space =
        1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y) | 1u << unsigned(Axis::Z);
    const bool stated =
        !anyPlane_ || ctx.after().active(ctx.dialect(), StandardGroup::Plane) != groupUnset;
    const uint16_t plane = stated ? planeAxes(ctx.dialect(), ctx.after()) : space;
    return llvm::any_of(ctx.outcome().events, [&](const Event &e) {
      return e.kind == EventKind::Motion && (e.axes & plane);
    });
  }

  void atCode(const Event &event, RuleContext &ctx) {
    const CodeInfo &code = ctx.code(event);
    const bool off = code.action == Action::CompensationOff;
    if (off && cancelAlone_)
      return;
    const uint8_t before = ctx.before().compensation, after = ctx.after().compensation;
    const uint8_t waiting = off ? phaseEnding : phaseStarting;
    if (!(after & waiting) || (off ? !(before & phaseOn) : (before & phaseOn)) || movesInPlane(ctx))
      return;
    // `G47 K`: it begins at the foot of the normal to the next element.
    if (!off && llvm::any_of(ctx.block().words, [&](const Word &w) {
          return w.has(wordNoValue) && (code.takes & maskOf(w.address));
        }))
      return;
    const bool certain = after == waiting && (off ? before == phaseOn : !(before & phaseOn));
    auto finding = ctx.report(event, certain);
    if (!finding)
      return;
    const bool alone = axesOf(ctx.dialect(), ctx.block()) == 0;
    finding.message(
        "`{0}` has no move in the plane{1}: compensation is {2} by whichever move comes "
        "next",
        code.name, alone ? "" : " in its block", off ? "removed" : "built up");
  }

  /// Called under compensation, the program's first block has to move in the plane: the call is a
  /// block without a move already.
  void atSubprogramStart(RuleContext &ctx) {
    if (ctx.callDepth() == 0 || ctx.before().compensation != phaseOn || ctx.before().profile != 0 ||
        ctx.before().idleBlocks == 0 || movesInPlane(ctx))
      return;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    Block block;
    uint32_t first = program.body;
    for (; first < ctx.block().begin; first = block.next) {
      ctx.index().reader().read(first, block);
      if (!block.isEmpty())
        return; // another block comes before
    }
    // Switched on in the caller, not in a previous pass of this program.
    const Origin &origin = ctx.before().origin.compensation;
    if (origin.known() && origin.file == ctx.source().id() && origin.begin >= program.begin &&
        origin.begin < program.end)
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
