// A code, word or form that the control's family has, but not this control.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class BlockCodeNotOnControl final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    if (!to.dialect().lexical.structures)
      to.on(EventKind::Statement);
    if (!to.dialect().lexical.incrementOperator)
      to.on(EventKind::Syntax);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement) {
      const Item &item = ctx.block().items[event.item()];
      const SourceRange range = ctx.range(item);
      if (item.kind == ItemKind::Structure || item.kind == ItemKind::Definition ||
          item.kind == ItemKind::Parameters || item.kind == ItemKind::Declaration)
        if (auto finding = ctx.report(range))
          finding.message("`{0}`: this control has no structured flow and no definitions",
                          ctx.text(range));
      return;
    }
    if (event.kind == EventKind::Code)
      return ctx.reportNotices(id, event);
    // `XI-4` reads as an X without a value and an I after it.
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    if (issue.kind != SyntaxIssueKind::MissingValue)
      return;
    for (const Word &word : ctx.block().words) {
      if (word.address != letterAddress('I') || word.offset != issue.end || !word.isNumber())
        continue;
      const SourceRange range{ctx.source().id(), issue.begin, ctx.block().endOf(word)};
      if (auto finding = ctx.report(range))
        finding.message("`{0}`: this control has no increment operator I, it reads two words",
                        ctx.text(range));
    }
  }

private:
  static constexpr llvm::StringLiteral id{"block-code-not-on-control"};
};

} // namespace
NCVET_RULE(BlockCodeNotOnControl, block_code_not_on_control)
} // namespace ncvet
