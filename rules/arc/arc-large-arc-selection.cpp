// A negative radius, or the flag in its place, where the arc over 180 degrees cannot be meant.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <cmath>

namespace ncvet {
namespace {

class ArcLargeArcSelection final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    everyNegative_ = to.dialect().facts->arcs.noNegativeRadius;
    tolerance_ = to.number("tolerance", 0.01);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const ArcWords &words = ctx.arcWords();
    if (!words.radius || words.hasCentre())
      return sleepInShape();
    const ArcGeometry &arc = ctx.arc();
    if (!arc.radius || *arc.radius >= 0)
      return;
    bool semicircle = false;
    if (arc.start && arc.end) {
      const double chord = distance(*arc.start, *arc.end);
      semicircle = std::fabs(chord / 2 + *arc.radius) <= tolerance_;
    }
    if (!semicircle && !everyNegative_)
      return;
    const Word *flag = ctx.block().find('K');
    const Word &word = flag && flag->has(wordNoValue) ? *flag : *words.radius;
    if (auto finding = ctx.report(word, event.certain)) {
      if (semicircle)
        finding.message("`{0}` asks for the arc over 180 degrees, but this one has 180: {1} "
                        "does nothing, rounding decides",
                        ctx.text(word), &word == flag ? "the flag" : "the sign");
      else
        finding.message("`{0}` selects the arc over 180 degrees, which is hardly ever turned",
                        ctx.text(word));
    }
  }

private:
  bool everyNegative_ = false;
  double tolerance_ = 0.01;
};

} // namespace
NCVET_RULE(ArcLargeArcSelection, arc_large_arc_selection)
} // namespace ncvet
