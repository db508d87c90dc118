// A feed move or cutting cycle runs without a feed ever having been programmed.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FeedMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode || ctx.after().must(Fact::FeedSet))
      return;
    const CodeInfo &code = ctx.code(event);
    if (!code.needsFeed || event.motion == MotionKind::Reference)
      return;
    const bool certain = event.certain && !ctx.after().may(Fact::FeedSet);
    if (auto finding = ctx.report(event, certain))
      finding.message("`{0}` cuts, but no feed was programmed", code.name)
          .note(ctx.before().originOf(ctx.dialect(), StandardGroup::Motion),
                code.name + " becomes active here");
  }
};

} // namespace
NCVET_RULE(FeedMissing, feed_missing)
} // namespace ncvet
