// An arc block with both a radius and a centre.
#include "analyzer/rule.h"
#include "interp/arc.h"

namespace ncvet {
namespace {

class ArcOverdefined final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    const ArcWords words = arcWords(ctx.dialect(), ctx.after(), ctx.block());
    const Word *centre = words.centre[0] ? words.centre[0] : words.centre[1];
    if (words.angle && event.axes && (words.radius || (centre && isWhole(event, words)))) {
      if (auto finding = ctx.report(*words.angle, event.certain))
        finding.message("`{0}` has an opening angle beside {1}: the two need not agree, and the "
                        "control stops",
                        ctx.code(event).name,
                        words.radius ? "a radius"
                        : ctx.block().hasAny(ctx.dialect().lineAngleWords)
                            ? "the angle of its end"
                            : "an end point and a centre");
      return;
    }
    if (!words.radius || !centre || words.radius->has(wordNoValue) || centre->has(wordNoValue))
      return;
    const CodeInfo &code = ctx.code(event);
    // Controls that compute the intersection of over-determined blocks choose it by Q; they do so
    // under compensation.
    constexpr AddressId choice = letterAddress('Q');
    if ((code.takes & maskOf(choice)) && ctx.block().has(choice) &&
        ctx.after().compensationActive(ctx.dialect()) != Truth::No)
      return;
    if (auto finding = ctx.report(*words.radius, event.certain))
      finding.message(
          "`{0}` has both the radius {1} and a centre ({2}): one of the two is ignored, "
          "or the control stops",
          code.name, ctx.text(*words.radius), ctx.text(*centre));
  }

private:
  /// The block gives both coordinates of the end point.
  static bool isWhole(const Event &event, const ArcWords &words) {
    return (event.axes >> unsigned(words.axes[0]) & 1) &&
           (event.axes >> unsigned(words.axes[1]) & 1);
  }
};

} // namespace
NCVET_RULE(ArcOverdefined, arc_overdefined)
} // namespace ncvet
