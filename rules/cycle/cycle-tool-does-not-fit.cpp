// The tool is too large for what the cycle is to make.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CycleToolDoesNotFit final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices(id); }
  void on(const Event &event, RuleContext &ctx) const override { ctx.reportNotices(id, event); }

private:
  static constexpr llvm::StringLiteral id{"cycle-tool-does-not-fit"};
};

} // namespace
NCVET_RULE(CycleToolDoesNotFit, cycle_tool_does_not_fit)
} // namespace ncvet
