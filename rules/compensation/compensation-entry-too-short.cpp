// The move that builds up or removes compensation is shorter than the radius.
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/tool_data.h"

#include <cmath>

namespace ncvet {
namespace {

class CompensationEntryTooShort final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CompensationMove);
    longer_ = to.dialect().facts->compensation.entryLonger;
    if (longer_)
      to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion)
      return besidePlane(event, ctx);
    if (event.code == noCode || (ctx.outcome().kinds & bitOf(EventKind::CoordinateChange)))
      return;
    const Dialect &dialect = ctx.dialect();
    auto known = compensationRadius(dialect, ctx.machine(), ctx.before());
    if (!known)
      known = compensationRadius(dialect, ctx.machine(), ctx.after());
    if (!known || *known == 0 || ownEntry(dialect, ctx.after()))
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
    constexpr double rounding = 1e-4, exactly = 1e-9; // mm
    const double way = std::sqrt(squares), radius = std::fabs(*known);
    const bool off = ctx.code(event).action == Action::CompensationOff;
    if (longer_ ? off || way > radius + exactly : way >= radius - rounding)
      return;
    const bool certain = event.certain && !ctx.before().may(Fact::UnknownCode);
    if (auto finding = ctx.report(ctx.blockRange(), certain))
      finding
          .message("the move that {0} compensation is {1:f3} mm long, {3} than the radius of "
                   "{2:f3} mm: the control stops, or the tool cuts into the contour",
                   off ? "removes" : "builds up", way, radius, longer_ ? "not longer" : "shorter")
          .note(ctx.before().origin.of(StatePart::Tool), "the tool is called here");
  }

private:
  /// The control goes to the contour by a path of its own, or makes the contour without the entry.
  static bool ownEntry(const Dialect &dialect, const MachineState &state) {
    const auto usual = [](const CodeInfo &code) { return code.opposite == noCode; };
    return mayBeUnusual(dialect, state, "approach", usual) ||
           mayBeUnusual(dialect, state, "approach-check", usual);
  }

  /// A control that takes the first move for the one that builds compensation up, whatever its
  /// axes.
  static void besidePlane(const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    if (state.compensation != phaseStarting)
      return sleepInShape();
    if (event.code == noCode || !event.axes || event.motion == MotionKind::Reference ||
        event.motion == MotionKind::Skip)
      return;
    const auto radius = compensationRadius(ctx.dialect(), ctx.machine(), state);
    if (!radius || *radius == 0)
      return;
    if (auto finding = ctx.report(ctx.blockRange(), !state.may(Fact::UnknownCode)))
      finding
          .message(
              "the move that builds up compensation has no length in the plane, and the radius is "
              "{0:f3} mm: the control stops",
              std::fabs(*radius))
          .note(state.origin.of(StatePart::Tool), "the tool is called here");
  }

  bool longer_ = false; ///< the move on has to be longer than the radius; the one off need not
};

} // namespace
NCVET_RULE(CompensationEntryTooShort, compensation_entry_too_short)
} // namespace ncvet
