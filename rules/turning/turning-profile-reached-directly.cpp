// Plain flow runs the blocks of a profile that a finishing cycle runs as well.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"

namespace ncvet {
namespace {

class TurningProfileReachedDirectly final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::FlowIssue); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.flowIssue() != FlowIssue::ProfileReached)
      return;
    const Flow &flow = ctx.outcome().flow;
    const std::string name =
        flow.code == noCode ? std::string("the cycle") : ctx.dialect().codes[flow.code].name;
    const SourceRange first = ctx.flowRelated();
    if (ctx.dialect().profileRunsThrough) {
      if (auto finding = ctx.report(ctx.flowRange()))
        finding
            .message("`{0}` runs N{1} to N{2} once more: after the roughing cycle the control has "
                     "finished along them already",
                     name, flow.first, flow.last)
            .note(first, "the profile begins here");
      return;
    }
    if (roughedBefore(flow, first.begin, ctx))
      return;
    Block block;
    ctx.index().read(first.begin, block);
    SourceRange range{first.file, block.end, block.begin};
    for (const Word &word : block.words) {
      range.begin = std::min(range.begin, word.offset);
      range.end = std::max(range.end, block.endOf(word));
    }
    if (range.begin >= range.end)
      range = first;
    const bool later = first.begin > ctx.flowRange().begin;
    if (auto finding = ctx.report(range))
      finding
          .message(
              later
                  ? "plain flow runs into the profile N{0} to N{1}: the control has gone on after "
                    "`{2}` of line {3}, and cuts the finished contour once more"
                  : "plain flow reaches the profile N{0} to N{1}: the finished contour is cut at "
                    "once, and `{2}` of line {3} cuts it again",
              flow.first, flow.last, name, ctx.source().lines().lineOf(ctx.flowRange().begin))
          .note(ctx.flowRange(), "the cycle that runs this profile");
  }

private:
  /// The block before the profile begins a cycle that roughs it, and names another end: that is
  /// told there.
  static bool roughedBefore(const Flow &flow, uint32_t begin, const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(begin);
    bool roughs = false;
    for (const Block &block : blocks(ctx.index(), program.body, begin)) {
      if (block.isEmpty())
        continue;
      const Word *const first = block.find('P');
      roughs = first && first->isNumber() && first->mantissa == flow.first &&
               findReading(ctx.dialect(), block,
                           [](const CodeInfo &code) { return roughsProfile(code.cycle); });
    }
    return roughs;
  }
};

} // namespace
NCVET_RULE(TurningProfileReachedDirectly, turning_profile_reached_directly)
} // namespace ncvet
