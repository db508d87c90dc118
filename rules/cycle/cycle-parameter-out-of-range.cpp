// A word of a canned or turning cycle has a value that the cycle does not take.
#include "analyzer/word_checks.h"

namespace ncvet {
namespace {

constexpr llvm::StringLiteral id = "cycle-parameter-out-of-range";

class CycleParameterOutOfRange final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Cycle ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    // A later block of a modal cycle may give a word anew.
    if (event.kind == EventKind::CycleRun &&
        llvm::any_of(ctx.codes(), [&](const CodeUse &use) { return use.code == event.code; }))
      return;
    reportWordRanges(ctx, event, [](const CodeInfo &code, const WordSpec &spec, Breach) {
      return code.action == Action::Cycle && topicOf(code, spec) == WordTopic::Cycle;
    });
    if (event.kind == EventKind::Code)
      ctx.reportNotices(id, event);
  }
};

} // namespace
NCVET_RULE(CycleParameterOutOfRange, cycle_parameter_out_of_range)
} // namespace ncvet
