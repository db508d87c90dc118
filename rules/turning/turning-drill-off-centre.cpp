// A drilling cycle that the main spindle drives runs beside its axis.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"

#include <cmath>

namespace ncvet {
namespace {

class TurningDrillOffCentre final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      to.on(EventKind::CycleRun);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || !makesHole(ctx.code(event).cycle))
      return;
    if (ctx.block().has(letterAddress('C'))) // the C axis holds the part
      return;
    const MachineState &state = ctx.after(), &before = ctx.before();
    const Interval &x = state.at(Axis::X);
    if (toolAxis(ctx.dialect(), state) != Axis::Z || !x.isConstant() ||
        std::fabs(x.value()) < 1e-3 || state.inMachineCoordinates(Axis::X))
      return;
    // With a driven tool the main spindle does not turn.
    const auto live = ctx.machine().option("liveTools");
    const bool noLive = live && *live == "false";
    const bool mainTurns = before.spindle == spindleCw || before.spindle == spindleCcw;
    if (!mainTurns || before.liveTool != spindleOff ||
        (!noLive && (before.may(Fact::UnknownCode) || before.may(Fact::AxisEngaged) ||
                     before.may(Fact::SpindleClamped))))
      return;
    if (std::fabs(x.value()) < 4 && isIndexable(ctx))
      return;
    if (auto finding = ctx.report(event, event.certain && noLive))
      finding
          .message(before.at(Axis::C).isConstant()
                       ? "`{0}` drills at X{1}, and the spindle that C has positioned turns: no "
                         "driven tool was started"
                       : "`{0}` drills at X{1} while the main spindle turns: the drill is not on "
                         "its axis",
                   ctx.code(event).name, shortPlace(ctx, x.value()))
          .note(before.origin.of(StatePart::Spindle), "the spindle is started here");
  }

private:
  /// The comments of the tool name a drill with inserts, which is shifted to open the hole.
  static bool isIndexable(const RuleContext &ctx) {
    constexpr uint32_t before = 400; // bytes: the tool's comments may be before its block
    const Origin &tool = ctx.before().origin.of(StatePart::Tool);
    if (!isHere(ctx, tool))
      return false;
    const uint32_t from = tool.begin > before ? tool.begin - before : 0;
    const llvm::StringRef text = ctx.source().text(from, ctx.block().begin);
    for (size_t at = text.find('('); at != llvm::StringRef::npos; at = text.find('(', at + 1)) {
      const llvm::StringRef comment = text.substr(at).split(')').first;
      if (comment.contains_insensitive("U-DRILL") || comment.contains_insensitive("UDRILL") ||
          comment.contains_insensitive("U DRILL") || comment.contains_insensitive("INDEX") ||
          comment.contains_insensitive("INSERT DRILL") || comment.contains_insensitive("880-D"))
        return true;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(TurningDrillOffCentre, turning_drill_off_centre)
} // namespace ncvet
