// A tool change for which no tool was selected.
#include "analyzer/facts/silent_program.h"
#include "analyzer/facts/unnamed_tool_change.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct ToolChangeWithoutToolMemory {
  NamelessChanges nameless;
};

class ToolChangeWithoutTool final : public StatefulRule<ToolChangeWithoutToolMemory> {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().toolChangeByT && to.dialect().facts->tools.changeNeedsNumber)
      to.onAction({Action::ToolChange});
    eachNamed_ = to.flag("each");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    const bool again = before.may(Fact::ToolCalled);
    // After a change that named nothing the next one is the same mistake.
    const bool named = !again || (eachNamed_ && !memory().nameless.inForce(before));
    memory().nameless.see(event, ctx);
    if (ctx.block().has(letterAddress('T')) || before.preselected != notSet || !named ||
        before.may(Fact::UnknownCode)) // an earlier T waits for the change
      return;
    // A program that is called changes to the tool that its caller has selected.
    if (!again && ctx.callDepth() == 0 && onlyReturns(ctx))
      return;
    if (auto finding = ctx.report(event)) {
      finding.message(again ? "`{0}` changes the tool, but no `T` has named one since the change "
                              "before"
                            : "`{0}` changes the tool, but no `T` has named one",
                      ctx.code(event).name);
      if (again)
        finding.note(before.origin.of(StatePart::Tool), "the change before");
    }
  }

private:
  bool eachNamed_ = false; ///< a later change wants a T of its own
};

} // namespace
NCVET_RULE(ToolChangeWithoutTool, tool_change_without_tool)
} // namespace ncvet
