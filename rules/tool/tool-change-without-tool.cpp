// A tool change for which no tool was selected.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ToolChangeWithoutTool final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().toolChangeByT && to.option("wanted", 0) != 0)
      to.onAction({Action::ToolChange});
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (ctx.block().has(letterAddress('T')) || ctx.before().may(Fact::ToolCalled) ||
        ctx.before().may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` changes the tool, but no `T` has named one", ctx.code(event).name);
  }
};

} // namespace
NCVET_RULE(ToolChangeWithoutTool, tool_change_without_tool)
} // namespace ncvet
