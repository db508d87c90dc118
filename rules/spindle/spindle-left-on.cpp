// A live tool that still turns at a tool change or at the program's end.
#include "analyzer/rule/switch_left_on.h"

namespace ncvet {
namespace {

class SpindleLeftOn final : public LeftOnRule {
public:
  SpindleLeftOn() : LeftOnRule("spindle-left-on") {}
  void listen(Subscriptions &to) override {
    LeftOnRule::listen(to);
    const unsigned atToolChange = to.choice("atToolChange", {"never", "afterCut", "always"}, 0);
    atToolChange_ = atToolChange != 0;
    always_ = atToolChange == 2;
    if (atToolChange_)
      to.on(EventKind::ToolChange);
    if (to.flag("atEnd")) {
      to.on(EventKind::ProgramEnd);
      if (to.flag("atStop"))
        to.onAction({Action::ProgramStop, Action::OptionalStop});
      atEnd_ = true;
    }
  }
  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::Code)
      LeftOnRule::on(event, ctx);
    if (atEnd_ && (event.kind == EventKind::ProgramEnd || event.kind == EventKind::Code) &&
        ctx.after().spindle && !(ctx.after().spindle & ~(spindleCw | spindleCcw)) &&
        !ctx.after().may(Fact::UnknownCode)) {
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Style)
            .message("the spindle still turns where the program stops")
            .note(ctx.after().origin.of(StatePart::Spindle), "it is started here");
      return;
    }
    if (event.kind == EventKind::Code)
      return underCompensation(event, ctx);
    if (event.kind != EventKind::ToolChange || !atToolChange_ ||
        (ctx.before().spindle & ~(spindleCw | spindleCcw)) || !ctx.before().spindle ||
        (!always_ && !ctx.before().must(Fact::CutSinceTool)) || ctx.find({Action::SpindleStop}))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(always_ ? Severity::Warning : Severity::Style)
          .message("the spindle still turns at this tool change")
          .note(ctx.before().origin.of(StatePart::Spindle), "it is started here");
  }

private:
  /// The stop is for a look or a hand at the work, and the tool stays at the contour.
  static void underCompensation(const Event &event, RuleContext &ctx) {
    const CodeInfo *code = ctx.before().activeCode(ctx.dialect(), StandardGroup::Compensation);
    if (ctx.before().compensation != phaseOn || !code || ctx.before().may(Fact::UnknownCode) ||
        ctx.find({Action::CompensationOff}))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Style)
          .message("the program stops with `{0}` on: the tool stays at the contour", code->name)
          .note(ctx.before().origin.of(StatePart::Compensation), "it is switched on here");
  }

  bool atToolChange_ = false, atEnd_ = false;
  bool always_ = false; ///< at a tool change that nothing was cut before, too
};

} // namespace
NCVET_RULE(SpindleLeftOn, spindle_left_on)
} // namespace ncvet
