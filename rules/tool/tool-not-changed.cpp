// A tool is named, and the program ends without having changed it in.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ToolNotChanged final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().toolChangeByT && to.option("wanted", 0) != 0)
      to.on({EventKind::ToolWord, EventKind::ToolChange, EventKind::ProgramEnd});
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (ctx.callDepth() > 0)
      return;
    if (event.kind == EventKind::ToolWord && event.word)
      named_ = ctx.range(*event.word);
    else if (event.kind == EventKind::ToolChange)
      named_ = {};
    else if (event.kind == EventKind::ProgramEnd && named_.end &&
             !ctx.after().may(Fact::UnknownCode))
      if (auto finding = ctx.report(named_))
        finding.message("`{0}` names a tool that nothing changes in: the program cuts with the one "
                        "before",
                        ctx.text(named_));
  }

private:
  SourceRange named_;
};

} // namespace
NCVET_RULE(ToolNotChanged, tool_not_changed)
} // namespace ncvet
