// Words of a cycle exclude each other.
#include "analyzer/facts/word_checks.h"

namespace ncvet {
namespace {

class CycleParameterConflict final : public Rule {
  static constexpr llvm::StringLiteral id = "cycle-parameter-conflict";

public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    to.onCode([](const CodeInfo &code) {
      return (code.action == Action::Cycle && !code.excludes.empty()) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (ctx.code(event).action == Action::Cycle)
      reportExcludedWords(ctx, event);
    ctx.reportNotices(id, event);
  }
};

} // namespace
NCVET_RULE(CycleParameterConflict, cycle_parameter_conflict)
} // namespace ncvet
