// A feed of zero or less.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class FeedNotPositive final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FeedWord); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (!(event.feed().hi <= 0))
      return sleepInShape();
    // Of several words the last one counts.
    if (ctx.block().repeated & maskOf(event.word->address))
      for (const Word &word : ctx.block().words)
        if (word.address == event.word->address && word.offset > event.word->offset)
          return;
    const bool negative = event.feed().hi < 0;
    if (!negative && isReplaced(ctx))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.message("`{0}`: {1}", ctx.text(*event.word),
                      negative
                          ? "a feed is above zero; the control stops with an alarm"
                          : "the axes do not move with a feed of zero, the tool rubs in the cut");
  }

private:
  /// The block moves nothing, and the next block that feeds has a feed of its own.
  static bool isReplaced(const RuleContext &ctx) {
    constexpr unsigned furthest = 8; // blocks
    return comesInTime(
        ctx, furthest, [](const Block &next) { return next.has(letterAddress('F')); },
        [&](const Block &next) {
          return namesAxes(ctx.dialect(), next) && !findCode(ctx.dialect(), next, {Action::Rapid});
        });
  }
};

} // namespace
NCVET_RULE(FeedNotPositive, feed_not_positive)
} // namespace ncvet
