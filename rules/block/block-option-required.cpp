// A code that works only with an option of the machine that the profile does not confirm.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class BlockOptionRequired final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices(id); }
  void on(const Event &event, RuleContext &ctx) override { ctx.reportNotices(id, event); }

private:
  static constexpr llvm::StringLiteral id{"block-option-required"};
};

} // namespace
NCVET_RULE(BlockOptionRequired, block_option_required)
} // namespace ncvet
