// A canned or turning cycle lacks a word that it needs.
#include "analyzer/facts/word_checks.h"

namespace ncvet {
namespace {

class CycleMissingParameter final : public Rule {
  static constexpr llvm::StringLiteral id = "cycle-missing-parameter";

public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    if (llvm::any_of(to.dialect().codes, [](const CodeInfo &code) {
          return code.firesOnEveryBlock &&
                 llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
        }))
      to.on(EventKind::CycleRun);
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Cycle ||
             llvm::any_of(
                 code.words,
                 [&](const WordSpec &w) { return topicOf(code, w) == WordTopic::Cycle; }) ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun) {
      // A later hole of the cycle whose block gives a parameter anew.
      if (event.code != noCode && !ctx.codeWord(event) &&
          givesNoticedValue(ctx.block(), ctx.code(event), id))
        ctx.reportNotices(id, event);
      return;
    }
    // A list of arguments that breaks off is one slip, not one for each argument after it.
    if (llvm::any_of(ctx.block().issues, [](const SyntaxIssue &issue) {
          return issue.kind == SyntaxIssueKind::UnbalancedBracket;
        }))
      return;
    reportMissingWords(ctx, event, [](const CodeInfo &code, const WordSpec &spec) {
      return topicOfMissing(code, spec) == WordTopic::Cycle;
    });
    ctx.reportNotices(id, event);
  }
};

} // namespace
NCVET_RULE(CycleMissingParameter, cycle_missing_parameter)
} // namespace ncvet
