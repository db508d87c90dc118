// The spindle reversed while it turns.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class SpindleReversedWithoutStop final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::SpindleChange); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.before().profile == ProfileMode::Recorded)
      return;
    const CodeInfo &code = ctx.code(event);
    uint8_t other = 0;
    if (code.action == Action::SpindleCw)
      other = spindleCcw;
    else if (code.action == Action::SpindleCcw)
      other = spindleCw;
    else
      return;
    // The chuck of a tap takes up the reversal at the bottom of the hole.
    if (llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
          return ctx.code(use).ownMove && taps(ctx.code(use).cycle);
        }))
      return;
    const bool certain = ctx.before().spindle == other;
    if (!certain && (!(ctx.before().spindle & other) || ctx.before().may(Fact::UnknownCode) ||
                     ctx.before().spindle == spindleAny))
      return sleepInShape();
    if (auto finding = ctx.report(event, certain)) {
      finding
          .message("`{0}` reverses the spindle while it turns: chuck and drive take the load",
                   code.name)
          .note(ctx.before().origin.of(StatePart::Spindle), "it is started here");
      if (code.opposite != noCode) {
        const std::string &stop = ctx.dialect().codes[code.opposite].name;
        finding.fix(FixSafety::Unsafe, "insert `" + stop + "` before this block",
                    ctx.insertBlockBefore(stop));
      }
    }
  }
};

} // namespace
NCVET_RULE(SpindleReversedWithoutStop, spindle_reversed_without_stop)
} // namespace ncvet
