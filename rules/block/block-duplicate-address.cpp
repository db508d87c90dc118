// An address that may stand once stands twice in a block.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class BlockDuplicateAddress final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::WordIssue); }

  void on(const Event &event, RuleContext &ctx) override {
    if (WordIssue(event.number) != WordIssue::Repeated)
      return;
    // Arguments of a macro call may be given in several sets of I, J and K.
    if (ctx.find({Action::MacroCall, Action::MacroModal}))
      return;
    const Block &block = ctx.block();
    const AddressMask repeated = block.repeated & ~ctx.dialect().repeatable;
    AddressMask seen = 0;
    for (const Word &word : block.words) {
      const AddressMask mask = maskOf(word.address);
      if (!(repeated & mask) || word.has(wordNoValue)) // syntax-incomplete-word speaks of these
        continue;
      if (seen & mask)
        report(*block.find(word.address), word, ctx);
      seen |= mask;
    }
  }

private:
  static void report(const Word &first, const Word &again, RuleContext &ctx) {
    auto finding = ctx.report(again);
    if (!finding)
      return;
    const bool same = ctx.text(first) == ctx.text(again);
    finding.message(same ? "`{1}` stands twice in the block"
                         : "`{1}` stands in the block beside `{0}`: one of them is lost",
                    ctx.text(first), ctx.text(again));
    finding.note(ctx.range(first), "the first of the two");
    finding.fix(same ? FixSafety::Safe : FixSafety::Unsafe, "delete the second word",
                ctx.remove(again));
  }
};

} // namespace
NCVET_RULE(BlockDuplicateAddress, block_duplicate_address)
} // namespace ncvet
