// A feed move or cutting cycle runs without a feed ever having been programmed.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FeedMissing final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Motion, EventKind::CycleRun}); }

  void on(const Event &event, RuleContext &ctx) override {
    // Only the first cut: it is the same mistake in all that follow.
    if (event.code == noCode || ctx.after().must(Fact::FeedSet) || ctx.before().must(Fact::Cut) ||
        ctx.before().must(Fact::InContour) || // the cycle has feeds of its own
        ctx.after().may(Fact::UnknownCode))
      return;
    const CodeInfo &code = ctx.code(event);
    // A modal cycle without axis words sets modes only.
    if (event.kind == EventKind::CycleRun && !event.axes && code.group != noGroup &&
        !code.firesOnEveryBlock)
      return;
    if (!code.needsFeed ||
        (event.kind == EventKind::Motion &&
         (event.motion == MotionKind::Reference || event.motion == MotionKind::Rapid)))
      return;
    const bool certain = event.certain && !ctx.after().may(Fact::FeedSet);
    if (auto finding = ctx.report(event, certain))
      finding.message("`{0}` cuts, but no feed was programmed", code.name)
          .note(ctx.before().originOf(ctx.dialect(), StandardGroup::Motion),
                "`" + code.name + "` becomes active here");
  }
};

} // namespace
NCVET_RULE(FeedMissing, feed_missing)
} // namespace ncvet
