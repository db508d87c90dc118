// A code or word that is used as another control reads it.
#include "analyzer/lookahead.h"

namespace ncvet {
namespace {

class BlockForeignDialectCode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    if (to.dialect().polarWords & maskOf(letterAddress('O')))
      to.on(EventKind::WordIssue);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Code)
      return ctx.reportNotices(id, event);
    if (WordIssue(event.number) == WordIssue::Special)
      programNumber(ctx);
  }

private:
  /// `O1000` where O names an element of a contour: no program has a number.
  static void programNumber(RuleContext &ctx) {
    const Word *word = undefinedElement(ctx);
    if (!word || word->address != letterAddress('O'))
      return;
    if (auto finding = ctx.report(*word))
      finding.severity(Severity::Warning)
          .message("`{0}` is a {1} here, and none of this name is defined: programs have no number",
                   ctx.text(*word), ctx.dialect().addresses[word->address].title)
          .fix(FixSafety::Unsafe, "delete the block", ctx.remove(*word));
  }

  static constexpr llvm::StringLiteral id{"block-foreign-dialect-code"};
};

} // namespace
NCVET_RULE(BlockForeignDialectCode, block_foreign_dialect_code)
} // namespace ncvet
