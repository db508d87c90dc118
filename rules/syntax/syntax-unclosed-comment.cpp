// A comment that is not closed in its block, is nested, or is closed without having been opened.
#include "analyzer/rule/report_once.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct SyntaxUnclosedCommentMemory {
  OncePerCause once;
};

class SyntaxUnclosedComment final : public StatefulRule<SyntaxUnclosedCommentMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::Syntax);
    nestedStops_ = to.dialect().facts->text.noNestedComments;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    const SourceRange range = ctx.range(issue);
    switch (issue.kind) {
    case SyntaxIssueKind::UnclosedComment:
      if (auto finding = ctx.report(range))
        finding
            .text("the comment is not closed in its block: the control reads it into the next one")
            .fix(FixSafety::Unsafe, "close the comment at the end of the block",
                 ctx.insertBefore(issue.end, ctx.text(range).startswith("{") ? "}" : ")"));
      return;
    case SyntaxIssueKind::NestedComment: {
      const bool braces = ctx.text(range).startswith("{");
      if (nestedStops_) {
        if (auto finding = ctx.report(range))
          finding.text("a `(` inside a comment: the interpreter stops here");
        return;
      }
      // With nothing after the `)` the comment is read whole, but for one more bracket.
      if (ctx.source().text(issue.end, ctx.block().end).trim().empty())
        return;
      // Who writes brackets into comments does it throughout.
      if (!memory().once.speaks(Origin(), ctx))
        return;
      if (auto finding = ctx.report(range))
        finding
            .message(
                "a `{0}` inside a comment: the comment ends at the first `{1}`, what follows is "
                "read as code",
                braces ? '{' : '(', braces ? '}' : ')')
            .severity(Severity::Warning);
      return;
    }
    case SyntaxIssueKind::StrayParenthesis:
      if (auto finding = ctx.report(range))
        finding.text("a `)` without its `(`: the control cannot read it");
      return;
    default:
      return;
    }
  }

private:
  bool nestedStops_ = false; ///< the control stops at a `(` inside a comment
};

} // namespace
NCVET_RULE(SyntaxUnclosedComment, syntax_unclosed_comment)
} // namespace ncvet
