// A frame that replaces the one in force.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {
namespace {

class CoordinateFrameReplaced final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onAction({Action::FrameSet}); }

  void on(const Event &event, RuleContext &ctx) const override {
    const CodeInfo &code = ctx.code(event);
    if (code.effect.index >= maxSwitches || !code.effect.on ||
        !ctx.before().switchMustBeOn(code.effect.index) || ctx.before().may(Fact::UnknownCode))
      return;
    const Origin &origin = ctx.before().origin.ofSwitch(code.effect.index);
    // The same frame with other values is meant to replace it.
    if (origin.known() && ctx.text(origin.range()).equals_insensitive(ctx.text(*event.word)) &&
        !isOfOtherAxis(origin, ctx))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` deletes the frame that is in force: a frame on top of it is `A{0}`",
                   code.name)
          .note(origin, "that frame is programmed here");
  }

private:
  /// The block before gives the same frame for another axis, and nothing has moved in it.
  static bool isOfOtherAxis(const Origin &origin, const RuleContext &ctx) {
    Block previous;
    if (!isHere(ctx, origin) || !readPrevious(ctx, previous) || previous.begin > origin.begin ||
        origin.begin >= previous.end)
      return false;
    const uint16_t first = axesOf(ctx.dialect(), previous),
                   here = axesOf(ctx.dialect(), ctx.block());
    return first && here && !(first & here);
  }
};

} // namespace
NCVET_RULE(CoordinateFrameReplaced, coordinate_frame_replaced)
} // namespace ncvet
