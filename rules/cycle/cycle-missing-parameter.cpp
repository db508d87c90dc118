// A canned or turning cycle lacks a word that it needs.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
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
    reportMissingWords(ctx, event, [&](const CodeInfo &code, const WordSpec &spec) {
      return topicOfMissing(code, spec) == WordTopic::Cycle && !givenInTime(code, spec, ctx);
    });
    ctx.reportNotices(id, event);
  }

private:
  /// A cycle that its block only makes active reads its variables at its first place: a block
  /// between may give them.
  static bool givenInTime(const CodeInfo &code, const WordSpec &spec, RuleContext &ctx) {
    constexpr unsigned most = 20; // blocks that are read
    const AddressMask axes = ctx.dialect().axisWords;
    if (!spec.variable || !code.firesInPlane || ctx.block().hasAny(axes))
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < most && ahead.next(next); ++i) {
      if (assignmentOf(next, spec.variable))
        return true;
      if (next.hasAny(axes) || findCode(ctx.dialect(), next, {Action::Cycle, Action::CycleCancel}))
        return false;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(CycleMissingParameter, cycle_missing_parameter)
} // namespace ncvet
