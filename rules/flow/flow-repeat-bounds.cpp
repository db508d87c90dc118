// A section that is repeated ends before it begins, or holds the block that repeats it.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FlowRepeatBounds final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on({EventKind::FlowIssue, EventKind::Statement}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::FlowIssue) {
      if (FlowIssue(event.number) == FlowIssue::RepeatBounds)
        if (auto finding = ctx.report(ctx.flowRange(), event.certain))
          finding.message("`{0}` lies inside the section that it repeats, or the section ends "
                          "before it begins",
                          ctx.text(ctx.flowRange()));
      return;
    }
    const Item &item = ctx.block().items[size_t(event.number)];
    if (item.kind != ItemKind::Repeat || !item.single || item.arguments < 2)
      return;
    const SourceRange range{ctx.source().id(), item.begin, item.end};
    if (auto finding = ctx.report(range))
      finding.message("`{0}` repeats the one block of its label: it takes no second one",
                      ctx.text(range));
  }
};

} // namespace
NCVET_RULE(FlowRepeatBounds, flow_repeat_bounds)
} // namespace ncvet
