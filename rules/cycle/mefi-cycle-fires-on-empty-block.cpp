// A drilling cycle runs again in a block that moves nowhere.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {
namespace {

class MefiCycleFiresOnEmptyBlock final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().emptyBlocksRun)
      to.on(EventKind::CycleRun);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || event.axes)
      return;
    const CodeInfo &cycle = ctx.code(event);
    if (!makesHole(cycle.cycle) || !cycle.firesOnEveryBlock)
      return;
    for (const CodeUse &use : ctx.codes()) {
      const Action action = ctx.code(use).action;
      if (use.code == event.code || action == Action::ProgramEnd ||
          action == Action::ProgramEndRewind || action == Action::ToolChange ||
          action == Action::SpindleStop)
        return; // its own block, or the business of those who speak of cycles left on
    }
    if (ctx.block().has(letterAddress('T')))
      return; // the next tool is called: so do they of this
    const Origin &origin = ctx.before().origin.of(StatePart::Cycle);
    const std::string cancel = cancelOf(ctx.dialect(), cycle);
    SourceRange range = ctx.blockRange();
    if (range.end <= range.begin)
      range = {ctx.source().id(), ctx.block().begin, ctx.block().numberEnd};
    if (auto finding = ctx.report(range, event.certain))
      finding
          .message(
              "this block {0} the last hole again: `{1}` of line {2} runs in every block until "
              "`{3}`",
              verbOf(cycle.cycle), cycle.name, lineOf(ctx, origin), cancel)
          .note(origin, cycle.name + " becomes active here")
          .fix(FixSafety::Unsafe, "insert a block with " + cancel + " before this one",
               ctx.insertBlockBefore(cancel));
  }
};

} // namespace
NCVET_RULE(MefiCycleFiresOnEmptyBlock, mefi_cycle_fires_on_empty_block)
} // namespace ncvet
