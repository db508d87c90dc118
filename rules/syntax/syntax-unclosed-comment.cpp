// A comment that is not closed in its block, is nested, or is closed without having been opened.
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct SyntaxUnclosedCommentMemory {
  bool marked = false; ///< a comment with a % was told
  OncePerCause once;
  OncePerCause brackets; ///< of comments after which a bracket alone is left
};

class SyntaxUnclosedComment final : public StatefulRule<SyntaxUnclosedCommentMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::Syntax);
    if (to.dialect().facts->text.tapeMarkInComments)
      to.onChange({EventKind::Block});
    strings_ = to.flag("strings");
    nestedStops_ = to.dialect().facts->text.noNestedComments;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Block)
      return tapeMark(ctx);
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    const SourceRange range = ctx.range(issue);
    switch (issue.kind) {
    case SyntaxIssueKind::UnclosedComment:
      if (auto finding = ctx.report(range))
        finding
            .text(nestedStops_ ? "the comment is not closed in its line: the interpreter stops here"
                               : "the comment is not closed in its block: the control reads it "
                                 "into the next one")
            .fix(FixSafety::Unsafe, "close the comment at the end of the block",
                 ctx.insertBefore(issue.end, ctx.text(range).startswith("{") ? "}" : ")"));
      return;
    case SyntaxIssueKind::UnclosedString:
      if (!strings_)
        return;
      if (auto finding = ctx.report(range))
        finding.message("the string `{0}` has no closing quotation mark",
                        ctx.source().displayText(ctx.text(range)));
      return;
    case SyntaxIssueKind::NestedComment: {
      const bool braces = ctx.text(range).startswith("{");
      if (nestedStops_)
        return stopsAt(range, ctx);
      // With nothing after the `)` the comment is read whole, but for one more bracket.
      const llvm::StringRef left = ctx.source().text(issue.end, ctx.block().end).trim(" \t\r\n;");
      if (left.empty())
        return;
      if (left.trim(braces ? "} \t" : ") \t").empty())
        return bracketLeft(range, ctx);
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
  void stopsAt(const SourceRange &range, RuleContext &ctx) const {
    auto finding = ctx.report(range);
    if (!finding)
      return;
    if (isForOther_.of(ctx.source().id(), [&] { return isForPathPilot(ctx); }))
      finding.severity(Severity::Style)
          .text("a `(` inside a comment: PathPilot, for which this is written, takes it, "
                "LinuxCNC's own interpreter stops here");
    else
      finding.text("a `(` inside a comment: the interpreter stops here");
  }

  /// By file: what this control stops at another one of its kind takes.
  TextAnswers<FileId, bool> isForOther_;
  static bool isForPathPilot(const RuleContext &ctx) {
    constexpr size_t enough = 100'000; // bytes
    const llvm::StringRef text = ctx.source().text().take_front(enough);
    return text.contains_insensitive("pathpilot") || text.contains_insensitive("o<tormach") ||
           text.contains_insensitive("o<atc_");
  }

  /// `(HOLES (FIRST ROW) )`: nothing is read as code, but a bracket is left.
  void bracketLeft(const SourceRange &range, RuleContext &ctx) const {
    if (!memory().brackets.speaks(Origin(), ctx))
      return;
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Style)
          .text("the comment ends at its first closing bracket, and one more is left after it: "
                "most controls pass it over");
  }

  /// A `%` in a comment, the first of the file.
  void tapeMark(RuleContext &ctx) const {
    for (const Comment &comment : ctx.block().comments) {
      const size_t at = ctx.text(ctx.range(comment)).find('%');
      if (at == llvm::StringRef::npos || std::exchange(memory().marked, true))
        continue;
      const auto begin = uint32_t(comment.begin + at);
      if (auto finding = ctx.report(SourceRange{ctx.source().id(), begin, begin + 1}))
        finding.severity(Severity::Warning)
            .text("a `%` inside a comment: it ends the transfer of the program there");
    }
  }

  bool strings_ = false;     ///< strings are told here, not by syntax-unbalanced-brackets
  bool nestedStops_ = false; ///< the control stops at a `(` inside a comment
};

} // namespace
NCVET_RULE(SyntaxUnclosedComment, syntax_unclosed_comment)
} // namespace ncvet
