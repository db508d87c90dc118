// An arc by its radius where the centre would let the control check it.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class StyleRadiusArc final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw}); }

  void on(const Event &event, RuleContext &ctx) const override {
    const ArcWords &words = ctx.arcWords();
    if (event.code == noCode || !words.radius || words.hasCentre() || words.angle)
      return;
    if (auto finding = ctx.report(*words.radius, event.certain))
      finding.message("`{0}` is an arc by its radius: a wrong end point moves its centre, and the "
                      "control does not see it",
                      ctx.text(*words.radius));
  }
};

} // namespace
NCVET_RULE(StyleRadiusArc, style_radius_arc)
} // namespace ncvet
