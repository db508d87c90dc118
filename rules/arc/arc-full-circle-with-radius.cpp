// An arc by radius that ends where it starts.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <cmath>

namespace ncvet {
namespace {

class ArcFullCircleWithRadius final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    withCentre_ = to.dialect().facts->arcs.noFullCircle;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const ArcWords &words = ctx.arcWords();
    const bool byCentre = words.hasCentre() && !words.radius;
    if (!words.radius && !(byCentre && withCentre_))
      return sleepInShape();
    const ArcGeometry &arc = ctx.arc();
    constexpr double same = 1e-6; // mm
    const bool isShifted = ctx.outcome().kinds & bitOf(EventKind::CoordinateChange);
    if (arc.start && arc.end && !isShifted && distance(*arc.start, *arc.end) > same)
      return; // as nearly all do, it leads away
    // Without a word of the plane the end is the start, wherever that is.
    uint16_t plane = 0;
    for (const Axis axis : words.axes)
      plane |= uint16_t(1u << unsigned(axis));
    const bool staysPut = !(axesOf(ctx.dialect(), ctx.block()) & plane);
    // An angle says where the arc ends as well.
    if (words.angle ||
        (ctx.code(event).takes & ctx.dialect().lineAngleWords & ctx.block().addresses))
      return;
    const bool meets = arc.start && arc.end && !isShifted;
    if ((!staysPut && !meets) || !words.planeKnown)
      return;
    // With its centre beside the radius its neighbours give the ends; of a radius alone another
    // rule speaks.
    if (staysPut && ctx.dialect().facts->arcs.centreAndEnd)
      return;
    // A rotary axis gives the end: polar interpolation, or a builder's own.
    constexpr uint16_t rotary =
        1u << unsigned(Axis::A) | 1u << unsigned(Axis::B) | 1u << unsigned(Axis::C);
    if (staysPut && (axesOf(ctx.dialect(), ctx.block()) & rotary))
      return;
    // A radius of zero is reported as such.
    if (arc.radius && *arc.radius == 0)
      return;
    const bool certain = event.certain && (staysPut || !ctx.before().may(Fact::UnknownCode));
    if (auto finding = ctx.report(ctx.blockRange(), certain)) {
      if (byCentre)
        finding.message("`{0}` ends where it starts: a full circle cannot be turned",
                        ctx.code(event).name);
      else
        finding.message("`{0}` with {1} ends where it starts: the control cannot find the circle",
                        ctx.code(event).name, ctx.text(*words.radius));
    }
  }

private:
  bool withCentre_ = false;
};

} // namespace
NCVET_RULE(ArcFullCircleWithRadius, arc_full_circle_with_radius)
} // namespace ncvet
