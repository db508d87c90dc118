// A place of the contour into which the compensated tool does not fit.
#include "analyzer/facts/contour_trail.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <cmath>

namespace ncvet {
namespace {

struct CompensationRadiusTooLargeMemory {
  bool squeezed = false; ///< the last element was one that does not fit between its neighbours
  std::optional<ContourTrail> trail;
};

class CompensationRadiusTooLarge final : public StatefulRule<CompensationRadiusTooLargeMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.machine().tools.empty() && to.dialect().toolRadius.variable.empty())
      return;
    exact_ = to.machine().number("interferenceCheck").value_or(0) != 0 ||
             to.dialect().facts->compensation.checksExactly;
    slack_ = to.dialect().facts->compensation.checksExactly ? 0 : shallowCut;
    stopsAfter_ = to.dialect().facts->compensation.stopsAfterMove;
    memory().trail.emplace(to.dialect(), to.machine());
    to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if ((before.compensation | after.compensation) == phaseOff ||
        before.profile == ProfileMode::Recorded)
      return sleepInShape();
    memory().trail->take(
        ctx, event.certain && !after.may(Fact::UnknownCode),
        [&](const ContourTrail::Element &element, const Neighbours &neighbours,
            const ElementCorners &corners) { judge(element, neighbours, corners, ctx); });
  }

private:
  void judge(const ContourTrail::Element &element, const Neighbours &neighbours,
             const ElementCorners &corners, RuleContext &ctx) const {
    Misfit what = misfit(element.line, corners, element.left, exact_, slack_);
    if (element.entry && what == Misfit::Element) // it may begin anywhere
      what = Misfit::Fits;
    if (what == Misfit::Fits) {
      memory().squeezed = false;
      return;
    }
    // An element that its neighbour has no room beside has none beside that either.
    const bool again = what == Misfit::Element && memory().squeezed;
    memory().squeezed = what == Misfit::Element;
    if (!again)
      tell(what, element, neighbours, ctx);
  }

  void tell(Misfit what, const ContourTrail::Element &at, const Neighbours &neighbours,
            RuleContext &ctx) const {
    const double radius = std::fabs(at.left);
    const char *does = "the control stops, or the tool cuts into what is beside the path";
    const bool later = stopsAfter_ && what != Misfit::Arc;
    auto finding = ctx.report(later ? placeAfterMove(ctx) : at.range, at.certain);
    if (!finding)
      return;
    if (what == Misfit::Arc && at.corner)
      finding.message("the rounding of an inside corner has a radius of {0:f3} mm, the tool one of "
                      "{1:f3} mm: {2}",
                      at.line.radius(), radius, does);
    else if (what == Misfit::Arc)
      finding.message("this inside arc has a radius of {0:f3} mm, the tool one of {1:f3} mm: {2}",
                      at.line.radius(), radius, does);
    else if (later)
      finding
          .message("the tool with its radius of {0:f3} mm does not get into the corner before "
                   "this move: {1}",
                   radius, does)
          .note(at.range, what == Misfit::Corner ? "the element before it ends too far off"
                                                 : "the element before it is too short");
    else if (what == Misfit::Corner)
      finding.message("the tool with its radius of {0:f3} mm does not get into the inside corner "
                      "at the end of this move: {1}",
                      radius, does);
    else
      finding.message("this element is {0:f3} mm long, and the tool with its radius of {1:f3} mm "
                      "does not get in between its neighbours, {2} mm would: {3}",
                      at.line.length(), radius, roomFor(at, neighbours), does);
    finding.note(at.tool, "the tool is called here");
  }

  /// The current move, or the code that has ended the contour before it.
  static SourceRange placeAfterMove(const RuleContext &ctx) {
    const Origin end = ctx.after().originOf(ctx.dialect(), StandardGroup::Compensation);
    return ctx.after().compensation & phaseOn || !end.known() ? ctx.blockRange() : end.range();
  }

  std::string roomFor(const ContourTrail::Element &at, const Neighbours &neighbours) const {
    const auto room = largestFit(at.line, neighbours, at.left > 0, exact_);
    return formatted("{0:f2}", std::floor(room.value_or(0) * 100) / 100);
  }

  bool exact_ = false;
  bool stopsAfter_ = false; ///< told at the block that makes the control stop
  double slack_ = shallowCut;
};

} // namespace
NCVET_RULE(CompensationRadiusTooLarge, compensation_radius_too_large)
} // namespace ncvet
