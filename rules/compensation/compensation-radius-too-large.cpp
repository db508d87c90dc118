// An arc on whose inner side the compensated tool has no room.
#include "analyzer/rule.h"
#include "interp/arc.h"
#include "interp/tool_data.h"

#include <cmath>

namespace ncvet {
namespace {

class CompensationRadiusTooLarge final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.machine().tools.empty())
      to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const Dialect &dialect = ctx.dialect();
    // On the move that switches compensation on or off an arc is another rule's matter.
    if (event.code == noCode || ctx.before().compensation != phaseOn ||
        ctx.after().compensation != phaseOn || ctx.before().profile == 1)
      return;
    const Action side = ctx.after().activeAction(dialect, StandardGroup::Compensation);
    const bool clockwise = event.motion == MotionKind::ArcCw;
    // A turn to the side on which the tool stands is an inner one.
    if (side != (clockwise ? Action::CompensationRight : Action::CompensationLeft))
      return;
    const ToolData *tool = compensatingTool(dialect, ctx.machine(), ctx.after());
    if (!tool || !tool->radius || *tool->radius <= 0)
      return;
    const ArcGeometry arc = arcGeometry(arcWords(dialect, ctx.after(), ctx.block()), dialect,
                                        ctx.machine(), ctx.block(), ctx.before(), ctx.after());
    std::optional<double> radius;
    if (arc.radius)
      radius = std::fabs(*arc.radius);
    else if (const auto centre = arc.centre(); centre && arc.start)
      radius = std::hypot((*centre)[0] - (*arc.start)[0], (*centre)[1] - (*arc.start)[1]);
    else if (arc.centreWords && !arc.centreAbsolute)
      radius = std::hypot((*arc.centreWords)[0], (*arc.centreWords)[1]);
    constexpr double rounding = 1e-3; // mm: a centre is written with so many digits
    if (!radius || *radius == 0 || *radius >= *tool->radius - rounding)
      return;
    const bool certain = event.certain && !ctx.before().may(Fact::UnknownCode);
    if (auto finding = ctx.report(ctx.blockRange(), certain))
      finding
          .message("this inside arc has a radius of {0:f3} mm, the tool one of {1:f3} mm: the "
                   "control stops, or the tool cuts into what stands beside the arc",
                   *radius, *tool->radius)
          .note(ctx.after().origin.tool, "the tool is called here");
  }
};

} // namespace
NCVET_RULE(CompensationRadiusTooLarge, compensation_radius_too_large)
} // namespace ncvet
