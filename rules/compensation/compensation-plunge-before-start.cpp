// A cutter that is fed down to depth before compensation is switched on.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CompensationPlungeBeforeStart final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().isLathe())
      to.on(EventKind::CompensationMove);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.code(event).action == Action::CompensationOff ||
        !ctx.before().must(Fact::PlungedUncompensated))
      return;
    const CodeUse *use = ctx.find({Action::CompensationLeft, Action::CompensationRight});
    const SourceRange where = use ? ctx.range(*use->word) : ctx.blockRange();
    if (auto finding = ctx.report(where, event.certain))
      finding.message(
          "`{0}` comes when the tool is fed down to depth already: it went in beside the "
          "place where compensation puts it",
          ctx.code(event).name);
  }
};

} // namespace
NCVET_RULE(CompensationPlungeBeforeStart, compensation_plunge_before_start)
} // namespace ncvet
