// A cutter that is fed down to depth before compensation is switched on.
#include "analyzer/facts/path_ahead.h"
#include "analyzer/rule/rule.h"
#include "interp/geometry/direction.h"

namespace ncvet {
namespace {

class CompensationPlungeBeforeStart final : public Rule {
public:
  void listen(Subscriptions &to) override {
    onContour_ = to.flag("onContour");
    if (!to.dialect().isLathe())
      to.on(EventKind::CompensationMove);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.code(event).action == Action::CompensationOff ||
        !ctx.before().must(Fact::PlungedUncompensated))
      return;
    if (startsWithWear(ctx) || leadsInByArc(ctx) || (onContour_ && isOutside(ctx)))
      return;
    const CodeUse *use = ctx.find({Action::CompensationLeft, Action::CompensationRight});
    const SourceRange where = use ? ctx.range(*use->word) : ctx.blockRange();
    if (auto finding = ctx.report(where, event.certain))
      finding.message(
          "`{0}` comes when the tool is fed down to depth already: it went in beside the "
          "place where compensation puts it",
          ctx.code(event).name);
  }

private:
  bool onContour_ = false; ///< beside the contour the tool may go down

  /// The way to the contour is shorter than any tool's radius: the path is that of the tool's
  /// centre, and compensation corrects its wear alone.
  static bool startsWithWear(const RuleContext &ctx) {
    constexpr double shortest = 0.5; // mm
    const MachineState &from = ctx.before(), &to = ctx.after();
    if (!from.at(Axis::X).isConstant() || !from.at(Axis::Y).isConstant() ||
        !to.at(Axis::X).isConstant() || !to.at(Axis::Y).isConstant())
      return false;
    const Vector way(to.at(Axis::X).value() - from.at(Axis::X).value(),
                     to.at(Axis::Y).value() - from.at(Axis::Y).value());
    return way.norm() < shortest;
  }

  /// The move leads to an arc by which the contour is met: out of the middle of a bore, or to a
  /// roll-in that touches the contour's next element. Down beside it nothing is spoilt. Also where
  /// the arc is not known: it is one of variables.
  static bool leadsInByArc(const RuleContext &ctx) {
    const Interval &x = ctx.before().at(Axis::X), &y = ctx.before().at(Axis::Y);
    PathAhead ahead(ctx);
    if (!x.isConstant() || !y.isConstant() || !ahead.next())
      return false;
    const ExecutedBlock after = ahead.executed();
    const auto arc = contourElementOf(after);
    if (!arc)
      return after.after.activeAction(ctx.dialect(), StandardGroup::Motion) == Action::ArcCw ||
             after.after.activeAction(ctx.dialect(), StandardGroup::Motion) == Action::ArcCcw;
    if (!arc->arc)
      return false;
    constexpr double inside = 0.99; // of the radius
    if ((Vector(x.value(), y.value()) - arc->centre).norm() < inside * arc->radius())
      return true;
    if (!ahead.next())
      return false;
    const auto contour = contourElementOf(ahead.executed());
    constexpr double touches = 0.02; // radians: coordinates are rounded
    return contour && std::abs(angleBetween(arc->direction(arc->to),
                                            contour->direction(contour->from))) < touches;
  }

  /// The tool went down outside of the box round the contour that it then walks.
  static bool isOutside(const RuleContext &ctx) {
    constexpr unsigned longest = 200; // elements
    const Interval &x = ctx.before().at(Axis::X), &y = ctx.before().at(Axis::Y);
    if (!x.isConstant() || !y.isConstant())
      return false;
    Interval boxX = emptyInterval, boxY = emptyInterval;
    const auto take = [&](const MachineState &state) {
      const Interval &toX = state.at(Axis::X), &toY = state.at(Axis::Y);
      if (!toX.isConstant() || !toY.isConstant())
        return false;
      boxX = {std::min(boxX.lo, toX.lo), std::max(boxX.hi, toX.hi)};
      boxY = {std::min(boxY.lo, toY.lo), std::max(boxY.hi, toY.hi)};
      return true;
    };
    if (!take(ctx.after()))
      return false;
    PathAhead ahead(ctx);
    for (unsigned i = 0; i < longest && ahead.next(); ++i) {
      const ExecutedBlock executed = ahead.executed();
      if (executed.after.compensation != phaseOn)
        return !boxX.contains(x.value()) || !boxY.contains(y.value());
      if (!take(executed.after))
        return false;
    }
    return false;
  }
};

} // namespace
NCVET_RULE(CompensationPlungeBeforeStart, compensation_plunge_before_start)
} // namespace ncvet
