// A comment in the manner of another control.
#include "analyzer/facts/foreign_condition.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class SyntaxForeignComment final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Syntax); }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    if (issue.kind != SyntaxIssueKind::ForeignComment || isOfCondition(issue, ctx))
      return;
    const SourceRange range = ctx.range(issue);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` opens no comment on this control: it reads what follows as code",
                      ctx.text(range).take_front(1));
  }

private:
  /// `IF (R1<5) && (R2>80)`: block-foreign-dialect-code speaks of the sign.
  static bool isOfCondition(const SyntaxIssue &issue, const RuleContext &ctx) {
    return llvm::any_of(ctx.block().items, [&](const Item &item) {
      const ForeignSign sign = foreignSignIn(item, ctx.source().text(item.begin, ctx.block().end));
      return sign && item.begin + sign.at < issue.begin;
    });
  }
};

} // namespace
NCVET_RULE(SyntaxForeignComment, syntax_foreign_comment)
} // namespace ncvet
