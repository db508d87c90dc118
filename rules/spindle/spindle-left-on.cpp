// A live tool that still turns at a tool change or at the program's end.
#include "analyzer/left_on.h"

namespace ncvet {
namespace {

class SpindleLeftOn final : public LeftOnRule {
public:
  SpindleLeftOn() : LeftOnRule("spindle-left-on") {}
  void listen(Subscriptions &to) override {
    LeftOnRule::listen(to);
    if (to.option("atToolChange", 0) != 0)
      to.on(EventKind::ToolChange);
    atToolChange_ = to.option("atToolChange", 0) != 0;
  }
  void on(const Event &event, RuleContext &ctx) override {
    LeftOnRule::on(event, ctx);
    if (event.kind != EventKind::ToolChange || !atToolChange_ ||
        (ctx.before().spindle & ~(spindleCw | spindleCcw)) || !ctx.before().spindle ||
        !ctx.before().must(Fact::CutSinceTool))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Style)
          .message("the spindle still turns at this tool change")
          .note(ctx.before().origin.spindle, "it is started here");
  }

private:
  bool atToolChange_ = false;
};

} // namespace
NCVET_RULE(SpindleLeftOn, spindle_left_on)
} // namespace ncvet
