// The move that builds up or removes compensation is shorter than the radius.
#include "analyzer/rule.h"
#include "interp/tool_data.h"

#include <cmath>

namespace ncvet {
namespace {

class CompensationEntryTooShort final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::CompensationMove); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode || (ctx.outcome().kinds & bitOf(EventKind::CoordinateChange)))
      return;
    const Dialect &dialect = ctx.dialect();
    auto known = compensationRadius(dialect, ctx.machine(), ctx.before());
    if (!known)
      known = compensationRadius(dialect, ctx.machine(), ctx.after());
    if (!known || *known == 0)
      return;
    const uint16_t plane = planeAxes(dialect, ctx.after());
    double squares = 0;
    for (unsigned i = 0; i < axisCount; ++i) {
      if (!(plane >> i & 1) || !(event.axes >> i & 1))
        continue;
      const Interval &from = ctx.before().position[i], &to = ctx.after().position[i];
      if (!from.isConstant() || !to.isConstant() ||
          ((ctx.before().machineAxes | ctx.after().machineAxes) >> i & 1))
        return;
      double way = to.value() - from.value();
      if (llvm::any_of(dialect.addresses, [&](const AddressInfo &info) {
            return info.kind == AddressKind::Axis && info.axis == Axis(i) && info.diameter;
          }))
        way /= 2;
      squares += way * way;
    }
    constexpr double rounding = 1e-4; // mm
    const double way = std::sqrt(squares), radius = std::fabs(*known);
    if (way >= radius - rounding)
      return;
    const bool off = ctx.code(event).action == Action::CompensationOff;
    const bool certain = event.certain && !ctx.before().may(Fact::UnknownCode);
    if (auto finding = ctx.report(ctx.blockRange(), certain))
      finding
          .message("the move that {0} compensation is {1:f3} mm long, shorter than the radius of "
                   "{2:f3} mm: the control stops, or the tool cuts into the contour",
                   off ? "removes" : "builds up", way, radius)
          .note(ctx.before().origin.tool, "the tool is called here");
  }
};

} // namespace
NCVET_RULE(CompensationEntryTooShort, compensation_entry_too_short)
} // namespace ncvet
