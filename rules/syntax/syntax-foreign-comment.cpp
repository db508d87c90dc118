// A comment in the manner of another control.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class SyntaxForeignComment final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Syntax); }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    if (issue.kind != SyntaxIssueKind::ForeignComment)
      return;
    const SourceRange range = ctx.range(issue);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` opens no comment on this control: it reads what follows as code",
                      ctx.text(range).take_front(1));
  }
};

} // namespace
NCVET_RULE(SyntaxForeignComment, syntax_foreign_comment)
} // namespace ncvet
