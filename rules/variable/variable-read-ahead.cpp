// An actual value is read before the moves before it are done.
#include "analyzer/facts/preprocessor_reads.h"

namespace ncvet {
namespace {

class VariableReadAhead final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().readAhead.empty())
      return;
    to.on(EventKind::Statement);
    to.onChange({EventKind::Block});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    // A value that is kept is wanted for what it is worth; others may be signals to wait for.
    const bool kept = event.kind == EventKind::Statement &&
                      ctx.block().items[event.item()].kind == ItemKind::Assignment;
    eachPrepared(event, ctx, [&](const Expression &value) { look(value, !kept, ctx); });
  }

private:
  static void look(const Expression &value, bool ofAxis, RuleContext &ctx) {
    if (!readsAhead(value, ctx, ofAxis) || !movesBefore(ctx))
      return;
    // Under compensation the wait itself is the fault, and another rule's.
    if (ctx.before().compensationActive(ctx.dialect()) == Truth::Yes)
      return;
    const SourceRange range = ctx.range(value);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` is read while the moves before it still run: `STOPRE` makes the "
                      "control wait for them",
                      ctx.text(range));
  }

  /// Whether the control waits for its moves at the block.
  static bool waits(const Block &block, const Dialect &dialect) {
    return llvm::any_of(block.words, [&](const Word &word) {
      const CodeIndex code = codeOf(dialect, word);
      return code != noCode && dialect.codes[code].stopsPreparation;
    });
  }

  /// A move comes before, in plain order, and nothing that waits for it.
  static bool movesBefore(RuleContext &ctx) {
    constexpr unsigned lookBack = 20;
    Block block;
    uint32_t at = ctx.block().begin;
    const ProgramInfo &program = ctx.index().programAt(at);
    for (unsigned i = 0; i < lookBack && at > program.body; ++i) {
      at = ctx.source().lines().lineBegin(at - 1);
      ctx.index().read(at, block);
      if (block.hasLabel() || waits(block, ctx.dialect()))
        return false;
      if (block.hasAny(ctx.dialect().axisWords))
        return llvm::none_of(block.items,
                             [](const Item &one) { return one.kind == ItemKind::Structure; });
      for (const Item &item : block.items)
        if (item.kind != ItemKind::Assignment && item.kind != ItemKind::Output)
          return false;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(VariableReadAhead, variable_read_ahead)
} // namespace ncvet
