// A machine-coordinate move is written with increments.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CoordinateMachineMoveState final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices("coordinate-machine-move-state"); }
  void on(const Event &event, RuleContext &ctx) const override {
    ctx.reportNotices("coordinate-machine-move-state", event);
  }
};

} // namespace
NCVET_RULE(CoordinateMachineMoveState, coordinate_machine_move_state)
} // namespace ncvet
