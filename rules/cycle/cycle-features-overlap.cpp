// Slots or holes of one call run into each other.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CycleFeaturesOverlap final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices(id); }
  void on(const Event &event, RuleContext &ctx) override { ctx.reportNotices(id, event); }

private:
  static constexpr llvm::StringLiteral id{"cycle-features-overlap"};
};

} // namespace
NCVET_RULE(CycleFeaturesOverlap, cycle_features_overlap)
} // namespace ncvet
