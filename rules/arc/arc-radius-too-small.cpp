// An arc whose radius is zero or does not reach from start to end.
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/references.h"

#include <cmath>

namespace ncvet {
namespace {

class ArcRadiusTooSmall final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    tolerance_ = to.number("tolerance", 0.01);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const ArcWords &words = ctx.arcWords();
    const ArcGeometry &arc = ctx.arc();
    if (words.radius) {
      byRadius(*words.radius, arc, event, ctx);
      return;
    }
    const bool zero = arc.centreWords && !arc.centreAbsolute && (*arc.centreWords)[0] == 0 &&
                      (*arc.centreWords)[1] == 0;
    if (!zero || words.foreign)
      return;
    const Word &word = words.centre[0] ? *words.centre[0] : *words.centre[1];
    if (auto finding = ctx.report(word, event.certain))
      finding.message("the centre of `{0}` is the start point: an arc of radius 0 does not exist",
                      ctx.code(event).name);
  }

private:
  void byRadius(const Word &word, const ArcGeometry &arc, const Event &event,
                RuleContext &ctx) const {
    if (!arc.radius)
      return;
    if (*arc.radius == 0) {
      if (auto finding = ctx.report(word, event.certain))
        finding.message("`{0}`: an arc of radius 0 does not exist", ctx.text(word));
      return;
    }
    const bool sameBlockShift = ctx.outcome().kinds & bitOf(EventKind::CoordinateChange);
    // Radius and centre, or a Q: a circle of an intersection, whose ends are computed.
    if (!arc.start || !arc.end || sameBlockShift || arc.centreWords ||
        ctx.block().has(letterAddress('Q')))
      return;
    const double chord = distance(*arc.start, *arc.end);
    if (chord / 2 - std::fabs(*arc.radius) <= tolerance_)
      return;
    const bool certain = event.certain && !ctx.before().may(Fact::UnknownCode);
    auto finding = ctx.report(word, certain);
    if (!finding)
      return;
    finding.message("`{0}` is too small: start and end lie {1} apart, so the radius must be "
                    "at least {2}",
                    ctx.text(word), lengthText(ctx, chord), placeText(ctx, chord / 2));
    if (const SourceRange cycle = cycleThatEnds(ctx); cycle.end)
      finding.note(cycle,
                   "the profile of this cycle ends with the block before the arc: the arc is "
                   "made from where the cycle began");
  }

  /// The cycle whose profile ends with the block before this one; an empty range: there is none.
  static SourceRange cycleThatEnds(const RuleContext &ctx) {
    constexpr unsigned mostBlocks = 200; // of a profile
    Block last;
    if (!readPrevious(ctx, last) || last.number < 0)
      return {};
    Block block = last;
    bool named = false;
    for (unsigned i = 0; i < mostBlocks && readBack(ctx, block) && !named; ++i)
      ctx.unit().references().words(block, ctx.source().text(), [&](const Reference &reference) {
        named |= reference.kind == ReferenceKind::Last && reference.number == last.number;
      });
    return named ? wordsRange(ctx, block) : SourceRange();
  }

  double tolerance_ = 0.01; // mm
};

} // namespace
NCVET_RULE(ArcRadiusTooSmall, arc_radius_too_small)
} // namespace ncvet
