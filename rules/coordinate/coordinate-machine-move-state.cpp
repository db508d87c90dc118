// A machine-coordinate move is written with increments.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CoordinateMachineMoveState final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices("coordinate-machine-move-state"); }
  void on(const Event &event, RuleContext &ctx) const override {
    // Increments that a macro computes are meant: their author knows what the control makes of
    // them.
    const AddressMask axes = ctx.dialect().axisWords;
    const bool computed = llvm::any_of(ctx.block().words, [&](const Word &word) {
      return (axes & maskOf(word.address)) && word.has(wordExpression);
    });
    if (!computed)
      ctx.reportNotices("coordinate-machine-move-state", event);
  }
};

} // namespace
NCVET_RULE(CoordinateMachineMoveState, coordinate_machine_move_state)
} // namespace ncvet
