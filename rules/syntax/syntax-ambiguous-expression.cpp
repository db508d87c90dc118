// An expression that the control groups in another way than it looks.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class SyntaxAmbiguousExpression final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Syntax); }

  void on(const Event &event, RuleContext &ctx) override {
    const SyntaxIssue &issue = ctx.block().issues[size_t(event.number)];
    if (issue.kind != SyntaxIssueKind::AmbiguousExpression)
      return;
    const SourceRange range{ctx.source().id(), issue.begin, issue.end};
    if (auto finding = ctx.report(range))
      finding.message("in `{0}` AND, OR and NOT bind stronger than the comparisons: write each "
                      "comparison in brackets",
                      ctx.text(range));
  }
};

} // namespace
NCVET_RULE(SyntaxAmbiguousExpression, syntax_ambiguous_expression)
} // namespace ncvet
