// An arc whose end is not as far from its centre as its start.
#include "analyzer/facts/diameter_arc.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <cmath>

namespace ncvet {
namespace {

class ArcRadiusMismatch final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    tolerance_ = to.number("tolerance", 0.01);
    toleranceInch_ = to.number("toleranceInch", 0);
    relative_ = to.number("relative", 0);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const ArcWords &words = ctx.arcWords();
    if (!words.hasCentre() || words.radius || words.foreign ||
        (ctx.outcome().kinds & bitOf(EventKind::CoordinateChange)))
      return sleepInShape();
    if (!ctx.block().issues.empty()) // its words are not those that were meant
      return;
    const ArcGeometry &arc = ctx.arc();
    const auto centre = arc.centre();
    if (!centre || !arc.start || !arc.end)
      return;
    const double atStart = distance(*centre, *arc.start);
    const double atEnd = distance(*centre, *arc.end);
    // A centre on the start point is no circle at all: another rule says so.
    if (atStart == 0 || accepted(atStart, atEnd, ctx))
      return;
    const bool certain = event.certain && !ctx.before().may(Fact::UnknownCode);
    if (const auto halved = distancesAsDiameter(words, arc, ctx);
        halved && halved->first > tolerance_ && accepted(halved->first, halved->second, ctx))
      return asDiameter(event, certain, ctx);
    // The centre itself given for its distance: the rule of the centre convention says so.
    if (words.centre[0] && words.centre[1] && arc.centreWords) {
      const auto &given = *arc.centreWords;
      const double radius = distance(given, *arc.start);
      const double other = distance(given, *arc.end);
      if (radius > tolerance_ && std::fabs(radius - other) <= tolerance_)
        return;
    }
    if (auto finding = ctx.report(ctx.blockRange(), certain))
      finding.message("the end of `{0}` does not lie on its circle: the start is {1} from the "
                      "centre, the end {2}",
                      ctx.code(event).name, lengthText(ctx, atStart), lengthText(ctx, atEnd));
  }

private:
  /// The whole text may be meant so, or this arc alone.
  static void asDiameter(const Event &event, bool certain, RuleContext &ctx) {
    const auto &codes = ctx.dialect().codes;
    const auto on = llvm::find_if(
        codes, [](const CodeInfo &code) { return code.action == Action::DiameterOn; });
    if (on == codes.end())
      return;
    if (auto finding = ctx.report(ctx.blockRange(), certain))
      finding.message("`{0}` closes with X as a diameter, and `{1}` is not in force: the control "
                      "reads a radius",
                      ctx.code(event).name, on->name);
  }

  /// Whether the control takes the arc as a circle: the two distances, in mm, are near enough.
  bool accepted(double atStart, double atEnd, const RuleContext &ctx) const {
    // A part of the radius may be accepted beyond the tolerance, but never a gross step.
    constexpr double mostTolerances = 100;
    const bool inch = ctx.after().activeAction(ctx.dialect(), StandardGroup::Units) == Action::Inch;
    const double tolerance = inch && toleranceInch_ > 0 ? toleranceInch_ : tolerance_;
    const double step = std::fabs(atStart - atEnd);
    return step <= tolerance ||
           (step <= relative_ * std::max(atStart, atEnd) && step <= mostTolerances * tolerance);
  }

  double tolerance_ = 0.01, toleranceInch_ = 0; // mm
  double relative_ = 0;                         // of the radius
};

} // namespace
NCVET_RULE(ArcRadiusMismatch, arc_radius_mismatch)
} // namespace ncvet
