// An address without a number, or a number without an address.
#include "analyzer/facts/foreign_block.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class SyntaxIncompleteWord final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::Syntax);
    noBareAxes_ = to.dialect().facts->text.noBareAxes;
    limitAxes_ = to.dialect().facts->text.bareAxesOfLimits;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const SyntaxIssue &issue = ctx.block().issues[event.issue()];
    const SourceRange range = ctx.range(issue);
    if (issue.kind == SyntaxIssueKind::MissingAddress) {
      // A sleep code takes its time as a bare number.
      if (ctx.find({Action::Sleep}) || holdsForeignCode(ctx) ||
          ctx.block().repeatsIssue(event.issue()))
        return;
      if (auto finding = ctx.report(range))
        finding.message("`{0}` has no address before it", ctx.text(range));
      return;
    }
    if (issue.kind != SyntaxIssueKind::MissingValue || mayBeBare(issue, ctx))
      return;
    // The first such word of a block speaks for the others.
    for (size_t i = 0; i < event.issue(); ++i) {
      const SyntaxIssue &other = ctx.block().issues[i];
      if (other.kind == SyntaxIssueKind::MissingValue && !mayBeBare(other, ctx))
        return;
    }
    if (auto finding = ctx.report(range))
      finding.message("`{0}` has no value after it", ctx.text(range));
  }

private:
  /// Axis letters alone name the axes of a reference return, on some controls those of a limit too;
  /// an unknown letter has its own rule.
  bool mayBeBare(const SyntaxIssue &issue, const RuleContext &ctx) const {
    for (const Word &word : ctx.block().words) {
      if (word.offset != issue.begin)
        continue;
      const AddressMask mask = maskOf(word.address);
      return !(ctx.dialect().known & mask) ||
             ((ctx.dialect().axisWords & mask) &&
              ((!noBareAxes_ && ctx.find({Action::ReferenceReturn})) ||
               (limitAxes_ && ctx.find({Action::ZoneOn}))));
    }
    return false;
  }

  bool limitAxes_ = false;  ///< `G25 X Y` gives the limits of these axes up
  bool noBareAxes_ = false; ///< a reference return does not take axis letters alone
};

} // namespace
NCVET_RULE(SyntaxIncompleteWord, syntax_incomplete_word)
} // namespace ncvet
