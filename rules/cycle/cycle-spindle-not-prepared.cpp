// A cycle needs something of the spindle that the machine does not have or that was not prepared.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CycleSpindleNotPrepared final : public Rule {
  static constexpr llvm::StringLiteral id = "cycle-spindle-not-prepared";

public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    // Tapping by a move: the spindle follows the axis, and nothing in the code orients it.
    if (to.dialect().orientWords)
      to.onCode([](const CodeInfo &code) { return tapsByMove(code); });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (!ctx.dialect().orientWords || !tapsByMove(code) ||
        ctx.after().may(Fact::OrientedSinceTool) || ctx.after().may(Fact::UnknownCode))
      return;
    // Told at the first move; the retract from the thread says nothing new.
    const CodeInfo *motion = ctx.before().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (motion && tapsByMove(*motion))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` couples the spindle to the axis, and no {1} has positioned it",
                      code.name, ctx.dialect().alternatives(ctx.dialect().orientWords));
  }

private:
  static bool tapsByMove(const CodeInfo &code) {
    return code.action == Action::Thread && code.spindle == SpindleNeed::StartsItself;
  }
};

} // namespace
NCVET_RULE(CycleSpindleNotPrepared, cycle_spindle_not_prepared)
} // namespace ncvet
