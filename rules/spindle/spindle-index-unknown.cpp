// A word with the number of a spindle that the machine does not have.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class SpindleIndexUnknown final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (const auto count = to.machine().number("spindles"); count && *count >= 1) {
      spindles_ = unsigned(*count);
      to.on(EventKind::Statement);
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Item &item = ctx.block().items[event.item()];
    if (item.kind != ItemKind::Output)
      return;
    llvm::StringRef text = ctx.text(ctx.range(item));
    const char letter = text.empty() ? ' ' : char(text.front() & ~32);
    text = text.drop_front(!text.empty());
    unsigned spindle = 0;
    if ((letter != 'S' && letter != 'M') || text.consumeInteger(10, spindle) ||
        !text.ltrim().startswith("=") || spindle <= spindles_)
      return;
    if (auto finding = ctx.report(ctx.range(item)))
      finding.message("`{0}` speaks to spindle {1}, and the machine has {2}: the control stops",
                      ctx.text(ctx.range(item)), spindle,
                      spindles_ == 1 ? "one spindle" : std::to_string(spindles_) + " spindles");
  }

private:
  unsigned spindles_ = 0; ///< that the machine has
};

} // namespace
NCVET_RULE(SpindleIndexUnknown, spindle_index_unknown)
} // namespace ncvet
