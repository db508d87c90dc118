// A choice by value without a branch for every other value.
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class StyleCaseWithoutDefault final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::Statement); }

  void on(const Event &event, RuleContext &ctx) const override {
    const Item &item = ctx.block().items[event.item()];
    if (item.kind != ItemKind::Jump || item.jump != JumpKind::ByValue || item.arguments % 2 ||
        !item.arguments)
      return sleepAtBlock();
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.message("`{0}` has no DEFAULT: every other value runs on into the next block",
                      ctx.text(range));
  }
};

} // namespace
NCVET_RULE(StyleCaseWithoutDefault, style_case_without_default)
} // namespace ncvet
