// The spindle turns counter-clockwise with one tool of a mill, and clockwise with all others.
#include "analyzer/facts/program_tools.h"

namespace ncvet {
namespace {

class SpindleTurnsBackwards final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().isLathe())
      to.onAction({Action::SpindleCcw});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    constexpr unsigned habit = 2; // tools
    if (toolAxis(ctx.dialect(), ctx.after()) != Axis::Z || ctx.callDepth() > 0)
      return; // the work turns
    const ToolPart *const tool = tools_.inUse(ctx);
    if (!tool || !tool->cuts || tool->clockwise || tool->leftHanded ||
        !tools_.allButOne(
            ctx, habit,
            [](const ToolPart &part) { return part.clockwise || part.counterClockwise; },
            [](const ToolPart &part) { return !part.counterClockwise; }))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.message("`{0}` turns this tool backwards: all others of the program turn clockwise, "
                      "and it cuts no left-hand thread",
                      ctx.text(*event.word));
  }

private:
  ProgramTools tools_;
};

} // namespace
NCVET_RULE(SpindleTurnsBackwards, spindle_turns_backwards)
} // namespace ncvet
