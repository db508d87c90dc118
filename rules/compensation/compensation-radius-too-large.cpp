// An arc or a rounding on whose inner side the compensated tool has no room.
#include "analyzer/corner_words.h"
#include "analyzer/path_ahead.h"
#include "interp/arc.h"
#include "interp/tool_data.h"

#include <cmath>

namespace ncvet {
namespace {

class CompensationRadiusTooLarge final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.machine().tools.empty())
      return;
    corners_ = cornerAddresses(to.dialect());
    if (!corners_.rounding) {
      to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
      return;
    }
    reader_.emplace(to.dialect());
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw, MotionKind::Feed});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const Dialect &dialect = ctx.dialect();
    if (event.motion == MotionKind::Feed && !ctx.block().hasAny(corners_.rounding))
      return;
    // On the move that switches compensation on or off an arc is another rule's matter.
    if (event.code == noCode || ctx.before().compensation != phaseOn ||
        ctx.after().compensation != phaseOn || ctx.before().profile == 1)
      return;
    const ToolData *tool = compensatingTool(dialect, ctx.machine(), ctx.after());
    if (!tool || !tool->radius || *tool->radius <= 0)
      return;
    if (event.motion == MotionKind::Feed)
      onRounding(event, *tool->radius, ctx);
    else
      onArc(event, *tool->radius, ctx);
  }

private:
  static void onArc(const Event &event, double toolRadius, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const Action side = ctx.after().activeAction(dialect, StandardGroup::Compensation);
    const bool clockwise = event.motion == MotionKind::ArcCw;
    // A turn to the side on which the tool stands is an inner one.
    if (side != (clockwise ? Action::CompensationRight : Action::CompensationLeft))
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
    if (!radius || *radius == 0 || *radius >= toolRadius - tolerance)
      return;
    const bool certain = event.certain && !ctx.before().may(Fact::UnknownCode);
    if (auto finding = ctx.report(ctx.blockRange(), certain))
      finding
          .message("this inside arc has a radius of {0:f3} mm, the tool one of {1:f3} mm: the "
                   "control stops, or the tool cuts into what stands beside the arc",
                   *radius, toolRadius)
          .note(ctx.after().origin.tool, "the tool is called here");
  }

  /// Between two lines that turn to the side on which the tool stands.
  void onRounding(const Event &event, double toolRadius, RuleContext &ctx) const {
    if (takenByOther(ctx, corners_.plain))
      return;
    const CornerRequest corner = reader_->read(executedBlock(ctx));
    const Word *word = ctx.block().findAny(corners_.rounding);
    if (corner.kind != CornerRequest::Kind::Rounding || corner.size >= toolRadius - tolerance)
      return;
    const auto in = straightElement(executedBlock(ctx));
    PathAhead ahead(ctx);
    if (!in || !ahead.next() || ahead.executed().after.compensation != phaseOn)
      return;
    const auto out = straightElement(ahead.executed());
    if (!out || !takenByCorner(corner, *in, *out))
      return;
    const auto a = in->direction(), b = out->direction();
    const bool left = a[0] * b[1] - a[1] * b[0] > 0;
    const Action side = ctx.after().activeAction(ctx.dialect(), StandardGroup::Compensation);
    if (side != (left ? Action::CompensationLeft : Action::CompensationRight))
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding
          .message("`{0}` rounds an inside corner with {1:f3} mm, and the tool has a radius of "
                   "{2:f3} mm: the control stops, or the tool cuts into what stands beside it",
                   ctx.text(*word), corner.size, toolRadius)
          .note(ctx.after().origin.tool, "the tool is called here");
  }

  static constexpr double tolerance = 1e-3; // mm: a centre is written with so many digits
  CornerAddresses corners_;
  std::optional<CornerWords> reader_;
};

} // namespace
NCVET_RULE(CompensationRadiusTooLarge, compensation_radius_too_large)
} // namespace ncvet
