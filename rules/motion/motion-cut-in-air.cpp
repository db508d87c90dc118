// A tool is fed along its axis to above the work, and then cuts there: the depth has lost its sign.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class MotionCutInAir final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().isLathe())
      to.onMoves({MotionKind::Feed});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (event.axes != 1u << unsigned(Axis::Z) || event.code == noCode || !ctx.codeWord(event) ||
        ctx.code(event).action != Action::Linear ||
        before.activeAction(ctx.dialect(), StandardGroup::Motion) != Action::Rapid)
      return sleepInShape();
    const Interval &from = before.at(Axis::Z), &to = after.at(Axis::Z);
    const Word *const z = ctx.block().find(letterAddress('Z'));
    if (!z || !z->isNumber() || z->value() <= 0 || !event.certain || !from.isConstant() ||
        !to.isConstant() || from.value() <= 0 || before.may(Fact::UnknownCode) ||
        event.inMachineCoordinates() || before.machineAxes || !after.frames.empty() ||
        mayBeTransformed(ctx.dialect(), after) || turnsWork(ctx.dialect(), after) ||
        after.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
            Truth::No ||
        toolAxis(ctx.dialect(), after) != Axis::Z || !cutsNext(ctx))
      return;
    const bool rises = to.value() > from.value() + tolerance;
    if (!rises && !isDepthElsewhere(z->value(), ctx))
      return;
    if (auto finding = ctx.report(*z))
      finding.message("the tool is fed {0}, and cuts there, {1} above zero: a depth has the other "
                      "sign",
                      rises ? "up from where it came at rapid"
                            : "to a height that is a depth "
                              "elsewhere",
                      shortLength(ctx, to.value()));
  }

private:
  static constexpr double tolerance = 1e-6;

  /// The next block moves in the plane, at feed.
  static bool cutsNext(const RuleContext &ctx) {
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    const Dialect &dialect = ctx.dialect();
    BlocksAhead ahead(ctx);
    Block next;
    if (!ahead.next(next) || !next.items.empty() || next.skip >= 0)
      return false;
    const uint16_t axes = axesOf(dialect, next);
    return axes && !(axes & ~plane) &&
           (!next.has(letterAddress('G')) ||
            findCode(dialect, next,
                     {Action::Linear, Action::ArcCw, Action::ArcCcw, Action::CompensationLeft,
                      Action::CompensationRight})) &&
           !findCode(dialect, next, {Action::Rapid, Action::Cycle, Action::MachineMove});
  }

  /// The program feeds to the same height with the other sign, and to no other above zero.
  static bool isDepthElsewhere(double height, const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    bool found = false;
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
      const Word *const z = block.find(letterAddress('Z'));
      if (!z || !z->isNumber() || block.begin == ctx.block().begin ||
          !findCode(ctx.dialect(), block, {Action::Linear}))
        continue;
      if (z->value() > 0)
        return false;
      found |= z->value() == -height;
    }
    return found;
  }
};

} // namespace
NCVET_RULE(MotionCutInAir, motion_cut_in_air)
} // namespace ncvet
