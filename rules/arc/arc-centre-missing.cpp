// An arc block that says neither where its centre is nor how large its radius is.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "formats/dialect/measure.h"

#include <bit>

namespace ncvet {
namespace {

class ArcCentreMissing final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (llvm::any_of(to.dialect().codes, isCurveByCentre))
      to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw, MotionKind::Feed});
    else
      to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.motion == MotionKind::Feed)
      return curve(event, ctx);
    const ArcWords &words = ctx.arcWords();
    if (event.code != noCode && ctx.dialect().facts->arcs.centreAndEnd) {
      if (words.hasCentre())
        return incomplete(words, event, ctx);
      if (words.radius)
        return radiusAlone(words, event, ctx);
    }
    // A centre word of the wrong axis is another rule's business.
    if (words.radius || words.angle || words.hasCentre() ||
        ctx.block().hasAny(ctx.dialect().polarWords) || words.foreign || event.code == noCode)
      return sleepInShape();
    const CodeUse *here = ctx.find({Action::ArcCw, Action::ArcCcw});
    if (!here && ctx.before().may(Fact::UnknownCode)) // it may have changed how the axes move
      return;
    const std::string &name = ctx.code(event).name;
    if (auto finding = here ? ctx.report(*here->word, event.certain)
                            : ctx.report(ctx.blockRange(), event.certain)) {
      finding.message("`{0}` has neither {1} nor {2}: the control does not know the arc", name,
                      shapeWords(ctx.dialect()), centreWords(words, ctx));
      // Where a parameter makes a line of such a block, coordinates after an arc are meant as one.
      const bool lines = ctx.dialect().options.count("arcWithoutCentre") != 0;
      if (ctx.machine().option("arcWithoutCentre") == llvm::StringRef("alarm"))
        finding.severity(Severity::Error);
      else if (lines && !here)
        finding.severity(Severity::Style);
      if (!here)
        finding.note(ctx.before().originOf(ctx.dialect(), StandardGroup::Motion),
                     "`" + name + "` becomes active here and is still in force");
    }
  }

private:
  /// By its radius, and nothing that says where the arc ends.
  static void radiusAlone(const ArcWords &words, const Event &event, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    if (words.angle || words.foreign || !words.planeKnown ||
        (axesOf(dialect, ctx.block()) & planeAxes(dialect, ctx.after())) ||
        ctx.block().hasAny(dialect.polarWords | dialect.lineAngleWords))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding.message("`{0}` has a radius, {1}, and neither an end nor an angle: the control does "
                      "not know where the arc ends",
                      ctx.code(event).name, ctx.text(*words.radius));
  }

  /// By its centre: half of it, or nothing that says where the arc ends.
  static void incomplete(const ArcWords &words, const Event &event, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const bool half = !words.centre[0] || !words.centre[1];
    const bool ends = (axesOf(dialect, ctx.block()) & planeAxes(dialect, ctx.after())) ||
                      ctx.block().hasAny(dialect.polarWords | dialect.lineAngleWords);
    if (words.radius || words.foreign || !words.planeKnown ||
        (half ? words.angle || !ends : words.angle || ends))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.message(half ? "`{0}` has one word of its centre: it is {1} and {2}"
                           : "`{0}` has a centre, {1} and {2}, and neither an end, a radius nor an "
                             "angle: the control does not know where the arc ends",
                      ctx.code(event).name, dialect.addressName(words.centreAddress[0]),
                      dialect.addressName(words.centreAddress[1]));
  }

  /// `G12`: the words of its own block give the centre, as the table's measures say.
  static bool isCurveByCentre(const CodeInfo &code) {
    return code.action == Action::CurveFeed &&
           llvm::any_of(code.measures, [](const CycleMeasure &measure) {
             return measure.what == Measure::CentreFirst;
           });
  }

  /// A further arc of a code that runs on; of the first one the table speaks.
  static void curve(const Event &event, RuleContext &ctx) {
    if (event.code == noCode || !isCurveByCentre(ctx.code(event)) || ctx.codeWord(event) ||
        ctx.block().hasAny(lettersMask("IJK")))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("`{0}` is still in force and this arc has no centre: I and J, or K",
                   ctx.code(event).name)
          .note(ctx.before().originOf(ctx.dialect(), StandardGroup::Motion),
                "`" + ctx.code(event).name + "` becomes active here");
  }

  /// The words of the centre: of the axes that the block names, where no plane was chosen.
  static std::string centreWords(const ArcWords &words, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    constexpr uint16_t all = 0b111; // X, Y, Z
    const uint16_t axes = axesOf(dialect, ctx.block());
    const GroupIndex plane = dialect.group(StandardGroup::Plane);
    if (plane != noGroup && !ctx.after().isStated(plane) && std::popcount(axes) == 2 &&
        (axes & ~all) == 0)
      return axes & 1 ? (axes & 2 ? "I, J" : "I, K") : "J, K";
    return std::string(dialect.addressName(words.centreAddress[0])) + ", " +
           std::string(dialect.addressName(words.centreAddress[1]));
  }

  /// The words that give an arc without its centre: the radius, and the opening angle where there
  /// is one.
  static std::string shapeWords(const Dialect &dialect) {
    std::string text = dialect.addressName(dialect.arcRadius);
    if (dialect.arcAngle != noAddress)
      text += ", " + std::string(dialect.addressName(dialect.arcAngle));
    return text;
  }
};

} // namespace
NCVET_RULE(ArcCentreMissing, arc_centre_missing)
} // namespace ncvet
