// A code or word that is used as another control reads it.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class BlockForeignDialectCode final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices(id); }
  void on(const Event &event, RuleContext &ctx) override { ctx.reportNotices(id, event); }

private:
  static constexpr llvm::StringLiteral id{"block-foreign-dialect-code"};
};

} // namespace
NCVET_RULE(BlockForeignDialectCode, block_foreign_dialect_code)
} // namespace ncvet
