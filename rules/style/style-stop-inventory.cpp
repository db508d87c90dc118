// The places where the program may wait for the operator, or leave blocks out.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class StyleStopInventory final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::ProgramStop, Action::OptionalStop});
    to.on(EventKind::Block);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Block)
      return skipped(ctx);
    const bool optional = ctx.code(event).action == Action::OptionalStop;
    if (auto finding = ctx.report(event))
      finding.message(optional ? "`{0}`: the machine stops here when the operator has chosen it"
                               : "`{0}`: the machine stops here and waits for the operator",
                      ctx.code(event).name);
  }

private:
  static void skipped(RuleContext &ctx) {
    if (ctx.block().skip < 0)
      return;
    const uint32_t begin = ctx.block().begin;
    const llvm::StringRef line = ctx.text(SourceRange{ctx.source().id(), begin, ctx.block().end});
    const auto mark = uint32_t(line.find('/'));
    if (mark >= line.size())
      return;
    if (auto finding = ctx.report(SourceRange{ctx.source().id(), begin + mark, begin + mark + 1}))
      finding.message("the block is left out when the operator has chosen it");
  }
};

} // namespace
NCVET_RULE(StyleStopInventory, style_stop_inventory)
} // namespace ncvet
