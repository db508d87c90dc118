// A cycle needs something of the spindle that the machine does not have or that was not prepared.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

constexpr llvm::StringLiteral id = "cycle-spindle-not-prepared";

class CycleSpindleNotPrepared final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices(id); }
  void on(const Event &event, RuleContext &ctx) override { ctx.reportNotices(id, event); }
};

} // namespace
NCVET_RULE(CycleSpindleNotPrepared, cycle_spindle_not_prepared)
} // namespace ncvet
