// One axis with an absolute and an incremental word in the same block.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class BlockMixedAbsoluteIncremental final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().incrementWords)
      to.onChange({EventKind::Motion, EventKind::CycleStart, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Dialect &dialect = ctx.dialect();
    const Block &block = ctx.block();
    if (!block.hasAny(dialect.incrementWords) ||
        !block.hasAny(dialect.axisWords & ~dialect.incrementWords))
      return sleepInShape();
    const CodeInfo *cycle = event.code != noCode && ctx.code(event).action == Action::Cycle
                                ? &ctx.code(event)
                                : nullptr;
    for (const Word &word : block.words) {
      const AddressInfo &address = dialect.addresses[word.address];
      if (address.kind != AddressKind::Increment)
        continue;
      for (const Word &other : block.words) {
        const AddressInfo &absolute = dialect.addresses[other.address];
        if (absolute.kind != AddressKind::Axis || absolute.axis != address.axis)
          continue;
        // In a cycle both may have a meaning of their own: U as an allowance, X as the target.
        if (cycle && !alternatives(*cycle, maskOf(word.address) | maskOf(other.address)))
          continue;
        report(other, word, event, ctx);
      }
    }
  }

private:
  static bool alternatives(const CodeInfo &cycle, AddressMask both) {
    return llvm::any_of(cycle.words, [&](const WordSpec &w) { return (w.any & both) == both; });
  }

  static void report(const Word &absolute, const Word &increment, const Event &event,
                     RuleContext &ctx) {
    if (auto finding = ctx.report(increment, event.certain))
      finding
          .message("`{0}` and `{1}` move the same axis, one absolute and one incremental: "
                   "the end point is not defined",
                   ctx.text(absolute), ctx.text(increment))
          .note(ctx.range(absolute), "the absolute word");
  }
};

} // namespace
NCVET_RULE(BlockMixedAbsoluteIncremental, block_mixed_absolute_incremental)
} // namespace ncvet
