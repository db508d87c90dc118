// An arc block with both a radius and a centre.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ArcOverdefined final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw}); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const ArcWords &words = ctx.arcWords();
    const Word *centre = words.centre[0] ? words.centre[0] : words.centre[1];
    const uint16_t end = endWords(ctx);
    const bool endAngle = words.angle && (ctx.code(event).takes & ctx.dialect().lineAngleWords &
                                          ctx.block().addresses);
    if (words.angle && (endAngle || (end && (words.radius || (centre && isWhole(end, words)))))) {
      if (auto finding = ctx.report(*words.angle, event.certain))
        finding.message("`{0}` has an opening angle beside {1}: the two need not agree, and the "
                        "control stops",
                        ctx.code(event).name,
                        endAngle       ? "the angle of its end"
                        : words.radius ? "an end point and a radius"
                                       : "an end point and a centre");
      return;
    }
    if (!words.radius || !centre || words.radius->has(wordNoValue) || centre->has(wordNoValue))
      return sleepInShape();
    // The neighbours of an arc without an end give it.
    if (ctx.dialect().facts->arcs.centreAndEnd && !end)
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
  /// The axes whose end point the block gives: an arc may do without.
  static uint16_t endWords(const RuleContext &ctx) {
    // An angle of the end point is one, too.
    const bool polar = ctx.block().hasAny(ctx.dialect().polarWords | ctx.dialect().lineAngleWords);
    return uint16_t(axesOf(ctx.dialect(), ctx.block()) |
                    (polar ? planeAxes(ctx.dialect(), ctx.after()) : 0));
  }
  static bool isWhole(uint16_t end, const ArcWords &words) {
    return (end >> unsigned(words.axes[0]) & 1) && (end >> unsigned(words.axes[1]) & 1);
  }
};

} // namespace
NCVET_RULE(ArcOverdefined, arc_overdefined)
} // namespace ncvet
