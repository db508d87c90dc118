// A parameter that is written like a word, without the sign that gives it its value.
#include "analyzer/foreign_block.h"

#include "llvm/ADT/StringExtras.h"

#include <set>

namespace ncvet {
namespace {

class SyntaxAssignmentSign final : public Rule {
public:
  void listen(Subscriptions &to) override {
    for (const CodeInfo &code : to.dialect().codes)
      for (const WordSpec &spec : code.words)
        if (spec.variable) {
          parameters_.insert(spec.variable);
          letters_ |= spec.name.size() > 1 && llvm::isDigit(spec.name[1]);
        }
    for (const std::string &name : to.dialect().variableNames)
      names_.insert(variableKey(name));
    to.on(EventKind::Syntax);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const SyntaxIssue &issue = ctx.block().issues[size_t(event.number)];
    const SourceRange where{ctx.source().id(), issue.begin, issue.end};
    // `R2.` beside another control's code is a word of that control.
    if (issue.kind == SyntaxIssueKind::MissingEquals) {
      if (holdsForeignCode(ctx))
        return;
      if (auto finding = ctx.report(where))
        finding.message(
            "`{0}` lacks its `=`: an address of several letters, a variable and a value "
            "that is computed take one",
            ctx.text(where));
      return;
    }
    if (issue.kind == SyntaxIssueKind::AssignmentInTest) {
      if (auto finding = ctx.report(where))
        finding.message("`=` gives a value; two values are compared with `==`")
            .fix(FixSafety::Unsafe, "write `==`", ctx.replace(where, "=="));
      return;
    }
    if (issue.kind == SyntaxIssueKind::UnknownWord && isNamed(ctx.text(where))) {
      if (auto finding = ctx.report(where))
        finding.message("`{0}` is a variable: it takes its value with `=`", ctx.text(where));
      return;
    }
    if (!letters_ || issue.kind != SyntaxIssueKind::MalformedNumber)
      return;
    // `R31-15`: a letter, the parameter's digits, and a sign where the `=` is due.
    const SourceRange range{ctx.source().id(), issue.begin, issue.end};
    const llvm::StringRef text = ctx.text(range);
    const size_t sign = text.find_first_of("+-");
    if (sign == llvm::StringRef::npos || sign < 2 || !llvm::isAlpha(text[0]))
      return;
    const llvm::StringRef name = text.take_front(sign);
    if (!llvm::all_of(name.drop_front(), llvm::isDigit) || !parameters_.count(variableKey(name)))
      return;
    if (auto finding = ctx.report(range))
      finding
          .message("`{0}` gives `{1}` no value: a parameter is set with `=`, and keeps its old "
                   "value without it",
                   text, name)
          .fix(FixSafety::Unsafe, "write `=` behind the parameter",
               ctx.insertBefore(issue.begin + uint32_t(sign), "="));
  }

private:
  /// `<ENT:-5>`: the name of a variable where an instruction's is due.
  bool isNamed(llvm::StringRef text) const {
    text = text.ltrim("< ").take_until([](char c) { return c == ':' || c == ' ' || c == '>'; });
    return !text.empty() && names_.count(variableKey(text));
  }
  std::set<uint64_t> names_;      ///< of the control's own variables
  std::set<uint64_t> parameters_; ///< keys of the variables that codes read
  bool letters_ = false;          ///< some are a letter and digits, as words are
};

} // namespace
NCVET_RULE(SyntaxAssignmentSign, syntax_assignment_sign)
} // namespace ncvet
