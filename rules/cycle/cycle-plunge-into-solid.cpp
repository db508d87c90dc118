// A tool is fed down where material stands.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CyclePlungeIntoSolid final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onNotices(id); }
  void on(const Event &event, RuleContext &ctx) override { ctx.reportNotices(id, event); }

private:
  static constexpr llvm::StringLiteral id{"cycle-plunge-into-solid"};
};

} // namespace
NCVET_RULE(CyclePlungeIntoSolid, cycle_plunge_into_solid)
} // namespace ncvet
