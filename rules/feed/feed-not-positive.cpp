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
      finding.message(
          "`{0}`: {1}", ctx.text(*event.word),
          negative
              ? "a feed is above zero; the control stops with an alarm"
              : "the axes do not move with a feed of zero: the program waits, or stops with an "
                "alarm");
  }

private:
  /// The block moves nothing, and none of the next blocks feeds without a feed of its own.
  static bool isReplaced(const RuleContext &ctx) {
    constexpr unsigned furthest = 12; // blocks
    if (namesAxes(ctx.dialect(), ctx.block()) || ctx.find({Action::Cycle}))
      return false;
    bool rapid = false;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest; ++i) {
      if (!ahead.next(next) || next.has(letterAddress('F')))
        return true;
      for (const CodeIndex code : codesOf(ctx.dialect(), next))
        if (isMotion(ctx.dialect().codes[code].action))
          rapid = ctx.dialect().codes[code].action == Action::Rapid;
      if (namesAxes(ctx.dialect(), next) && !rapid)
        return false;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(FeedNotPositive, feed_not_positive)
} // namespace ncvet
