// Axis words stand before any motion code of the program.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class MotionModeNotSet final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Motion}); }

  void on(const Event &event, RuleContext &ctx) override {
    // Only where the power-on mode is not documented and nothing at all was stated.
    if (event.code != noCode || event.motion == MotionKind::Reference || reported_ ||
        ctx.dialect().group(StandardGroup::Motion) == noGroup ||
        ctx.after().active(ctx.dialect(), StandardGroup::Motion) != groupUnset ||
        ctx.after().may(Fact::UnknownCode))
      return;
    const Word *word = ctx.block().findAny(ctx.dialect().axisWords);
    if (!word || word->has(wordNoValue))
      return;
    reported_ = true;
    if (auto finding = ctx.report(*word))
      finding
          .message("`{0}` stands before any motion code: the power-on mode decides between rapid "
                   "and feed",
                   ctx.text(*word))
          .fix(FixSafety::Unsafe, "write `G0` in front of it",
               ctx.insertBefore(word->offset, "G0 "));
  }

private:
  bool reported_ = false; ///< the blocks behind it say the same thing again
};

} // namespace
NCVET_RULE(MotionModeNotSet, motion_mode_not_set)
} // namespace ncvet
