// The first cut of a tool runs with the feed of the tool before it.
#include "analyzer/facts/program_tools.h"

namespace ncvet {
namespace {

struct FeedCarriedOverToolChangeMemory {
  bool hasCut = false;   ///< a tool before the one in use has cut
  int64_t tool = notSet; ///< in use
};

class FeedCarriedOverToolChange final : public StatefulRule<FeedCarriedOverToolChangeMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::ToolChange);
    to.onChange({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::ToolChange)
      return changeTool(event, ctx);
    if (memory().hasCut && cuts(event, ctx))
      firstCut(event, ctx);
  }

  size_t onRow(const HoleRow &, size_t most, RuleContext &) const override {
    return memory().hasCut ? 0 : most;
  }

private:
  void changeTool(const Event &event, const RuleContext &ctx) const {
    const bool same = event.tool() >= 0 && event.tool() == memory().tool; // another offset of it
    memory().tool = event.tool();
    memory().hasCut = !same && ctx.before().must(Fact::Cut);
  }

  LLVM_ATTRIBUTE_NOINLINE void firstCut(const Event &event, RuleContext &ctx) const {
    memory().hasCut = false;
    const MachineState &after = ctx.after();
    const Origin &feed = after.origin.of(StatePart::Feed), &tool = after.origin.of(StatePart::Tool);
    if (!after.must(Fact::FeedSet) || after.may(Fact::UnknownCode) || after.may(Fact::FeedIsLead) ||
        !feed.known() || !tool.known() || feed.file != tool.file || feed.begin >= tool.begin ||
        ctx.block().has(letterAddress('F')) || tool.file != ctx.source().id())
      return;
    const bool slip = othersHaveTheirOwn(ctx);
    if (!slip && !ctx.asked())
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding.severity(slip ? std::optional(Severity::Warning) : std::nullopt)
          .message("`{0}` cuts with the feed of the tool before: this one has none of its own",
                   ctx.code(event).name)
          .note(feed, "the feed is programmed here")
          .note(tool, "the tool is called here");
  }

  /// At least three other tools of the program have a feed of their own at their first cut, and all
  /// but this one.
  bool othersHaveTheirOwn(const RuleContext &ctx) const {
    constexpr unsigned habit = 3; // tools
    return tools_.allButOne(
        ctx, habit, [](const ToolPart &part) { return part.cutsFirst != FirstCut::None; },
        [](const ToolPart &part) { return part.cutsFirst == FirstCut::OwnFeed; });
  }

  static bool cuts(const Event &event, const RuleContext &ctx) {
    if (event.code == noCode || !ctx.code(event).needsFeed)
      return false;
    return event.kind == EventKind::CycleRun ? event.axes != 0 && !taps(ctx.code(event).cycle)
                                             : isFeed(event.motion);
  }

  ProgramTools tools_;
};

} // namespace
NCVET_RULE(FeedCarriedOverToolChange, feed_carried_over_tool_change)
} // namespace ncvet
