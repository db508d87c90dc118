// A long chain of incremental moves where absolute values are safer.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

struct StylePreferAbsoluteMemory {
  unsigned count = 0;
  uint32_t last = 0;
  SourceRange first;
};

class StylePreferAbsolute final : public StatefulRule<StylePreferAbsoluteMemory> {
public:
  void listen(Subscriptions &to) override {
    longest_ = unsigned(to.number("blocks", 3));
    if (to.dialect().incrementWords || to.dialect().group(StandardGroup::Distance) != noGroup)
      to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || !isMotion(ctx.code(event).action))
      return;
    const Dialect &dialect = ctx.dialect();
    const Block &block = ctx.block();
    const AddressMask absolute = dialect.axisWords & ~dialect.incrementWords;
    const bool mode =
        ctx.after().activeAction(dialect, StandardGroup::Distance) == Action::Incremental;
    const bool incremental = mode ? block.hasAny(dialect.axisWords)
                                  : block.hasAny(dialect.incrementWords) && !block.hasAny(absolute);
    if (!incremental) {
      memory().count = 0;
      return;
    }
    // A chain is a run of the text: a loop that comes round again does not lengthen it.
    if (memory().count && block.begin <= memory().last)
      memory().count = 0;
    memory().last = block.begin;
    if (memory().count == 0)
      memory().first = ctx.range(block);
    if (++memory().count != longest_)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("{0} incremental moves in a row: one wrong value shifts all later points",
                   longest_)
          .note(memory().first, "the chain begins here");
  }

private:
  unsigned longest_ = 3;
};

} // namespace
NCVET_RULE(StylePreferAbsolute, style_prefer_absolute)
} // namespace ncvet
