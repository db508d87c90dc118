// A boring cycle waits for the operator, or shifts a tool whose direction nobody checked.
#include "analyzer/facts/lookahead.h"

namespace ncvet {
namespace {

class CycleManualOperation final : public Rule {
  static constexpr llvm::StringLiteral id = "cycle-manual-operation";

public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleStart);
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      return;
    }
    const CodeInfo &code = ctx.code(event);
    if (code.cycle == CycleKind::BoreManual || code.cycle == CycleKind::BoreDwellManual) {
      if (auto finding = ctx.report(event, event.certain))
        finding.message(
            "`{0}` waits at every hole until the operator has retracted the tool by hand",
            code.name);
      return;
    }
    if (code.cycle != CycleKind::FineBore && code.cycle != CycleKind::BackBore)
      return;
    if (ctx.before().may(Fact::OrientedSinceTool) || ctx.before().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("`{0}` shifts the tool at the bottom, and with this tool no M19 has shown yet "
                   "where its tip is",
                   code.name)
          .note(ctx.before().origin.of(StatePart::Tool), "the tool is changed here");
  }
};

} // namespace
NCVET_RULE(CycleManualOperation, cycle_manual_operation)
} // namespace ncvet
