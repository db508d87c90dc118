// A feed move or cutting cycle runs without a feed ever having been programmed.
#include "analyzer/once.h"

namespace ncvet {
namespace {

class FeedMissing final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Motion, EventKind::CycleRun}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode || ctx.after().must(Fact::FeedSet) ||
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
    if (event.kind == EventKind::CycleRun && hasOwnFeed(code, ctx)) {
      if (!ctx.after().may(Fact::FeedSet) && once_.speaks(ctx.after().origin.cycle, ctx))
        if (auto finding = ctx.report(event, event.certain))
          finding.severity(Severity::Style)
              .message("`{0}` lives on the feed of another call's parameters: the program has no F",
                       code.name);
      return;
    }
    // Only the first cut: it is the same mistake in all that follow.
    if (!once_.speaks(ctx.after().origin.feed, ctx))
      return;
    const bool certain = event.certain && !ctx.after().may(Fact::FeedSet);
    if (auto finding = ctx.report(event, certain))
      finding.message("`{0}` cuts, but no feed was programmed", code.name)
          .note(ctx.before().originOf(ctx.dialect(), StandardGroup::Motion),
                "`" + code.name + "` becomes active here");
  }
  void remember(RuleMemory &memory) const override { memory(once_); }

private:
  /// A feed among the cycle's own words, or among the variables that it reads.
  static bool hasOwnFeed(const CodeInfo &code, const RuleContext &ctx) {
    return llvm::any_of(code.words, [&](const WordSpec &spec) {
      return spec.role == Role::Feed && spec.variable &&
             (wordFor(ctx.block(), spec) || givenBefore(spec, ctx.before()) != Truth::No);
    });
  }

  OncePerCause once_;
};

} // namespace
NCVET_RULE(FeedMissing, feed_missing)
} // namespace ncvet
