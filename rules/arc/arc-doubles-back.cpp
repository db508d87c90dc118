// An arc that turns back on itself at both ends: the other direction of turning was meant.
#include "analyzer/facts/direction_before.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <cmath>

namespace ncvet {
namespace {

class ArcDoublesBack final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    cosine_ = unitVector(radiansOf(to.number("turn", 150))).x();
  }

  void on(const Event &event, RuleContext &ctx) const override {
    // In a chain of arcs under one code none is turned otherwise than its neighbours.
    const ArcWords &words = ctx.arcWords();
    if (event.code == noCode || !event.certain || !ctx.codeWord(event) || !words.hasCentre() ||
        words.foreign || words.angle)
      return sleepInShape();
    if (!isHalfATurnOrMore(event, ctx) || ctx.before().may(Fact::UnknownCode))
      return;
    const ExecutedBlock here = executedBlock(ctx);
    const auto begin = directionAt(here, false), end = directionAt(here, true);
    if (!begin || !end)
      return;
    PathAhead ahead(ctx);
    if (!ahead.next())
      return;
    const auto after = directionAt(ahead.executed(), false);
    if (!after || end->dot(*after) > cosine_)
      return;
    const auto before = directionBefore(ctx);
    if (!before || before->dot(*begin) > cosine_)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("`{0}` turns back at both ends of this arc: the path runs into it and out of it "
                   "the other way round",
                   ctx.code(event).name)
          .note(ahead.range(), "the next element");
  }

private:
  /// Whether the arc makes more than half a turn, as one of less does when it is turned the other
  /// way round, or half a turn after a line. Neighbours of others are not read: it costs time, and
  /// of half turns in a chain none is turned otherwise than its neighbours.
  static bool isHalfATurnOrMore(const Event &event, RuleContext &ctx) {
    const ArcGeometry &arc = ctx.arc();
    const auto centre = arc.centre();
    if (!arc.start || !arc.end || !centre || arc.radius)
      return false;
    const Vector from = *arc.start - *centre, to = *arc.end - *centre;
    const double sine = cross(from, to) * (event.motion == MotionKind::ArcCw ? -1 : 1);
    // Sine of what is less than half a turn for certain, and of what is less than a whole one.
    constexpr double little = 0.02;
    const double scale = from.norm() * to.norm();
    const bool half = std::fabs(sine) <= little * scale && from.dot(to) < 0;
    const bool afterLine =
        ctx.before().activeAction(ctx.dialect(), StandardGroup::Motion) == Action::Linear;
    return half ? afterLine : sine < -little * scale;
  }

  double cosine_ = 0; ///< of the turn from which on the path doubles back
};

} // namespace
NCVET_RULE(ArcDoublesBack, arc_doubles_back)
} // namespace ncvet
