// An arc that closes only when its centre words are read another way than the control reads them.
#include "analyzer/facts/diameter_arc.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <cmath>

namespace ncvet {
namespace {

struct ArcCentreConventionMemory {
  OncePerCause once;
};

class ArcCentreConvention final : public StatefulRule<ArcCentreConventionMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    tolerance_ = to.number("tolerance", 0.01);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const Dialect &dialect = ctx.dialect();
    const ArcWords &words = ctx.arcWords();
    if (!words.hasCentre() || words.radius || words.foreign ||
        (ctx.outcome().kinds & bitOf(EventKind::CoordinateChange)))
      return sleepInShape();
    const ArcGeometry &arc = ctx.arc();
    const auto centre = arc.centre();
    if (!centre || !arc.start || !arc.end ||
        radiusDifference(*centre, *arc.start, *arc.end) <= tolerance_)
      return;
    if (arc.centreAbsolute)
      return distance(event, words, arc, ctx);
    const Point &given = *arc.centreWords;
    const bool certain = event.certain && !ctx.before().may(Fact::UnknownCode);
    // A diameter given for a radius.
    for (size_t i = 0; i < 2; ++i) {
      if (!isDiameter(dialect, words.axes[i]) || given[i] == 0 || !words.centre[i])
        continue;
      Point half = given;
      half[i] /= 2;
      if (!fits(arc, {(*arc.start)[0] + half[0], (*arc.start)[1] + half[1]}))
        continue;
      const Word &word = *words.centre[i];
      if (auto finding = ctx.report(word, certain)) {
        // The control reads a radius, whatever its settings: beyond its tolerance it stops here.
        constexpr double greatest = 0.05; // mm
        if (radiusDifference(*centre, *arc.start, *arc.end) > greatest)
          finding.severity(Severity::Error);
        finding.message("the arc closes only with half of `{0}`: the control reads the centre "
                        "distance as a radius, not as a diameter",
                        ctx.text(word));
        if (word.isNumber())
          finding.fix(FixSafety::Unsafe, "write half the value",
                      ctx.replace(valueRange(word, ctx), shortNumber(word.value() / 2)));
      }
      return;
    }
    // The centre's coordinates given for its distance.
    if (!words.centre[0] || !words.centre[1] || !fits(arc, given))
      return;
    if (const auto halved = distancesAsDiameter(words, arc, ctx);
        halved && std::fabs(halved->first - halved->second) <= tolerance_)
      return; // arc-radius-mismatch speaks
    // A program that is written so is written so throughout: one report is enough.
    if (!memory().once.speaks(Origin(), ctx))
      return;
    if (auto finding = ctx.report(*words.centre[0], certain))
      finding.message("the arc closes only when `{0}` and `{1}` are the centre itself: the control "
                      "reads them as its distance from the start point",
                      ctx.text(*words.centre[0]), ctx.text(*words.centre[1]));
  }

private:
  /// The distance of the centre given where the control reads its coordinates.
  void distance(const Event &event, const ArcWords &words, const ArcGeometry &arc,
                RuleContext &ctx) const {
    const Point &given = *arc.centreWords;
    if (!words.centre[0] || !words.centre[1] ||
        !fits(arc, {(*arc.start)[0] + given[0], (*arc.start)[1] + given[1]}) ||
        !memory().once.speaks(Origin(), ctx))
      return;
    if (auto finding =
            ctx.report(*words.centre[0], event.certain && !ctx.before().may(Fact::UnknownCode)))
      finding.severity(Severity::Warning)
          .message("the arc closes only when `{0}` and `{1}` are the distance of the centre from "
                   "the start point: the control reads them as the centre itself",
                   ctx.text(*words.centre[0]), ctx.text(*words.centre[1]));
  }

  static bool isDiameter(const Dialect &dialect, Axis axis) {
    return llvm::any_of(dialect.addresses, [&](const AddressInfo &info) {
      return info.kind == AddressKind::Axis && info.axis == axis && info.diameter;
    });
  }
  bool fits(const ArcGeometry &arc, const Point &centre) const {
    const double radius = ncvet::distance(centre, *arc.start);
    return radius > tolerance_ && radiusDifference(centre, *arc.start, *arc.end) <= tolerance_;
  }
  static SourceRange valueRange(const Word &word, RuleContext &ctx) {
    return {ctx.source().id(), word.offset + 1, ctx.block().endOf(word)};
  }
  /// As a machinist writes it: at most four decimals, no trailing zeros.
  static std::string shortNumber(double value) {
    std::string text = formatted("{0:f4}", value);
    text.erase(text.find_last_not_of('0') + 1);
    return text;
  }

  double tolerance_ = 0.01; // mm
};

} // namespace
NCVET_RULE(ArcCentreConvention, arc_centre_convention)
} // namespace ncvet
