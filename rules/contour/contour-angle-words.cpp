// A line by angle has too many or too few coordinates, or is in a block that is no line.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/corner_words.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <bit>

namespace ncvet {
namespace {

class ContourAngleWords final : public Rule {
public:
  void listen(Subscriptions &to) override {
    corners_ = cornerAddresses(to.dialect());
    // A control that solves lines by their direction has rules of its own for them.
    corners_.angle &= ~to.dialect().lineAngleWords;
    if (corners_.angle)
      to.onChange({EventKind::Motion, EventKind::Block});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Word *angle = ctx.block().findAny(corners_.angle);
    if (!angle)
      return sleepInShape();
    if (ctx.before().profile == ProfileMode::Recorded)
      return;
    const bool plain = corners_.plain & maskOf(angle->address);
    if (plain && takenByOther(ctx, corners_.angle))
      return;
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    if (event.kind == EventKind::Block) {
      // Without an axis word there is no motion event.
      const Action mode = ctx.after().activeAction(ctx.dialect(), StandardGroup::Motion);
      if (axesOf(ctx, ctx.block()) & plane)
        return;
      if (mode != Action::Linear && !(mode == Action::Rapid && !plain))
        return;
      if (!plain && nextIntersects(ctx, plane))
        return;
      if (auto finding = ctx.report(*angle))
        finding.message(
            "`{0}` gives the direction of a line, but neither of its coordinates is given: it "
            "has no end",
            ctx.text(*angle));
      return;
    }
    if (!event.certain)
      return;
    const bool arc = isArc(event.motion);
    if (arc || event.motion == MotionKind::Thread || (plain && event.motion == MotionKind::Rapid)) {
      if (auto finding = ctx.report(*angle))
        finding.message(
            arc ? "`{0}` is in an arc: an angle gives the direction of a straight line"
                : "`{0}` is in a move that is no feed line: a line by angle is a G01 block",
            ctx.text(*angle));
      return;
    }
    if (plain && event.motion == MotionKind::Feed &&
        std::popcount(unsigned(event.axes & plane)) > 1)
      if (auto finding = ctx.report(*angle))
        finding.message(
            "`{0}` gives the direction of a line whose both coordinates are given: it takes one "
            "of them",
            ctx.text(*angle));
  }

private:
  /// A line of which only the angle is known ends where the next element begins.
  static bool nextIntersects(const RuleContext &ctx, uint16_t plane) {
    BlocksAhead ahead(ctx);
    Block next;
    if (!ahead.next(next))
      return !ahead.isOver();
    if (!next.items.empty())
      return true;
    if (findCode(ctx.dialect(), next, {Action::ArcCw, Action::ArcCcw}))
      return true;
    return next.has(commaA) && (axesOf(ctx, next) & plane) == plane;
  }

  CornerAddresses corners_;
};

} // namespace
NCVET_RULE(ContourAngleWords, contour_angle_words)
} // namespace ncvet
