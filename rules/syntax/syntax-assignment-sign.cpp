// A parameter that is written like a word, without the sign that gives it its value.
#include "analyzer/facts/foreign_block.h"
#include "analyzer/facts/instruction_name.h"

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
    instructions_ = instructionNames(to.dialect());
    if (!instructions_.empty())
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return instruction(ctx.block().items[event.item()], ctx);
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    const SourceRange where = ctx.range(issue);
    // `R2.` beside another control's code is a word of that control.
    if (issue.kind == SyntaxIssueKind::MissingEquals) {
      if (letters_ && parameter(where, ctx))
        return;
      if (holdsForeignCode(ctx))
        return;
      if (ctx.text(where).startswith("<"))
        return inBrackets(where, ctx);
      if (auto finding = ctx.report(where))
        finding.message(
            "`{0}` lacks its `=`: an address of several letters, a variable and a value "
            "that is computed take one",
            ctx.text(where));
      return;
    }
    if (issue.kind == SyntaxIssueKind::AssignmentInTest && ctx.text(where).startswith("==")) {
      if (auto finding = ctx.report(where))
        finding.message("`==` compares two values; a word takes its value with `=`")
            .fix(FixSafety::Unsafe, "write `=`", ctx.replace(where, "="));
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
  }

private:
  /// `R31-15`, `R28 4`: a letter, the parameter's digits, and its value. False: it is no parameter.
  bool parameter(const SourceRange &range, RuleContext &ctx) const {
    const llvm::StringRef text = ctx.text(range);
    const llvm::StringRef name = text.take_until([](char c) { return !llvm::isAlnum(c); });
    if (name.size() < 2 || !parameters_.count(variableKey(name)))
      return false;
    const llvm::StringRef value = text.drop_front(name.size()).ltrim(" \t");
    if (auto finding = ctx.report(range))
      finding
          .message("`{0}` gives `{1}` no value: a parameter is set with `=`, and keeps its old "
                   "value without it",
                   text, name)
          .fix(FixSafety::Unsafe, "write `=` after the parameter",
               ctx.replace({range.file, range.begin + uint32_t(name.size()),
                            range.end - uint32_t(value.size())},
                           "="));
    return true;
  }

  /// `<JMP=N40>`, `<ENT:-5>`: the sign of the other kind of bracket.
  static void inBrackets(SourceRange range, RuleContext &ctx) {
    const llvm::StringRef text = ctx.text(range);
    const bool instruction = text.endswith("=");
    const SourceRange sign{range.file, range.end - 1, range.end};
    if (auto finding = ctx.report(range))
      finding
          .message(instruction ? "`{0}` is an instruction: its arguments follow `:`"
                               : "`{0}` is a variable: it takes its value with `=`",
                   text.drop_front().drop_back().trim())
          .fix(FixSafety::Unsafe, instruction ? "write `:`" : "write `=`",
               ctx.replace(sign, instruction ? ":" : "="));
  }

  /// `<DCT=OFF>`: a value for what is an instruction.
  void instruction(const Item &item, RuleContext &ctx) const {
    const uint64_t key = ctx.block().keyOf(item.target);
    if (item.kind != ItemKind::Assignment || names_.count(key) || parameters_.count(key))
      return;
    const llvm::StringRef name =
        ctx.text(SourceRange{ctx.source().id(), item.nameBegin, item.nameEnd});
    if (!instructions_.count(name.upper()))
      return;
    const SourceRange where = ctx.range(item);
    if (auto finding = ctx.report(where))
      finding.severity(Severity::Warning)
          .message("`{0}` is an instruction and takes `:`: with `=` it is a variable that nothing "
                   "reads",
                   name);
  }

  /// `<ENT:-5>`: the name of a variable where an instruction's is due.
  bool isNamed(llvm::StringRef text) const {
    text = text.ltrim("< ").take_until([](char c) { return c == ':' || c == ' ' || c == '>'; });
    return !text.empty() && names_.count(variableKey(text));
  }
  std::set<uint64_t> names_;           ///< of the control's own variables
  std::set<uint64_t> parameters_;      ///< keys of the variables that codes read
  std::set<std::string> instructions_; ///< names of those in angle brackets
  bool letters_ = false;               ///< some are a letter and digits, as words are
};

} // namespace
NCVET_RULE(SyntaxAssignmentSign, syntax_assignment_sign)
} // namespace ncvet
