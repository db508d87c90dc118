// A cycle withdraws to a level inside the work, or below a clamp on the path to the next place.
#include "analyzer/facts/length_text.h"
#include "analyzer/rule/rule.h"
#include "interp/cycles/cycle_moves.h"
#include "interp/geometry/obstacle.h"

namespace ncvet {
namespace {

class CycleRetractTooLow final : public Rule {
public:
  /// Of the work the tables say when; the clamps are those of the machine profile.
  void listen(Subscriptions &to) override {
    if (!to.machine().clamps.empty() && !to.dialect().isLathe())
      to.on(EventKind::CycleRun);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (event.kind != EventKind::CycleRun || ctx.outcome().holes.empty() || !after.frames.empty() ||
        before.machineAxes || after.machineAxes || before.may(Fact::UnknownCode))
      return;
    llvm::SmallVector<Move, 16> moves;
    appendCycleMoves({ctx.dialect(), ctx.machine(), ctx.block(), ctx.outcome(), before, after},
                     event, moves);
    Place from = before.position;
    for (const Move &move : moves) {
      if (move.kind == MoveKind::Rapid && leadsAcross(from, move.to) &&
          llvm::any_of(ctx.machine().clamps, [&](const Stock &clamp) {
            return leadsThrough(clamp, from, move.to) == Truth::Yes;
          })) {
        if (auto finding = ctx.report(event))
          finding.message(
              "on the path to this place `{0}` leads through a clamp: it goes across at "
              "{1}",
              ctx.code(event).name, placeText(ctx, move.to[size_t(Axis::Z)].value()));
        return;
      }
      from = move.to;
    }
  }

private:
  static bool leadsAcross(const Place &from, const Place &to) {
    return !(from[0] == to[0] && from[1] == to[1]) && to[size_t(Axis::Z)].isConstant();
  }
};

} // namespace
NCVET_RULE(CycleRetractTooLow, cycle_retract_too_low)
} // namespace ncvet
