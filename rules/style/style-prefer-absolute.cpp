// A long chain of incremental moves where absolute values are safer.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class StylePreferAbsolute final : public Rule {
public:
  void listen(Subscriptions &to) override {
    longest_ = unsigned(to.option("blocks", 3));
    if (to.dialect().incrementWords || to.dialect().group(StandardGroup::Distance) != noGroup)
      to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) override {
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
      count_ = 0;
      return;
    }
    // A chain is a run of the text: a loop that comes round again does not lengthen it.
    if (count_ && block.begin <= last_)
      count_ = 0;
    last_ = block.begin;
    if (count_ == 0)
      first_ = {ctx.source().id(), block.begin, block.end};
    if (++count_ != longest_)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("{0} incremental moves in a row: one wrong value shifts all later points",
                   longest_)
          .note(first_, "the chain begins here");
  }
  void remember(RuleMemory &memory) const override { memory(count_, last_, first_); }

private:
  unsigned longest_ = 3;
  unsigned count_ = 0;
  uint32_t last_ = 0;
  SourceRange first_;
};

} // namespace
NCVET_RULE(StylePreferAbsolute, style_prefer_absolute)
} // namespace ncvet
