// An arc block that says neither where its centre is nor how large its radius is.
#include "analyzer/rule/rule.h"
#include "formats/dialect/measure.h"

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
    // A centre word of the wrong axis is another rule's business.
    if (words.radius || words.angle || words.hasCentre() ||
        ctx.block().hasAny(ctx.dialect().polarWords) || words.foreign || event.code == noCode)
      return;
    const CodeUse *here = ctx.find({Action::ArcCw, Action::ArcCcw});
    const std::string &name = ctx.code(event).name;
    if (auto finding = here ? ctx.report(*here->word, event.certain)
                            : ctx.report(ctx.blockRange(), event.certain)) {
      finding.message("`{0}` has neither {1} nor {2}, {3}: the control does not know the arc", name,
                      shapeWords(ctx.dialect()), ctx.dialect().addressName(words.centreAddress[0]),
                      ctx.dialect().addressName(words.centreAddress[1]));
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
