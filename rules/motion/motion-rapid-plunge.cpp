// A rapid move along the tool axis ends in the work.
#include "analyzer/facts/lookahead.h"
#include "formats/text/number_text.h"
#include "interp/geometry/obstacle.h"

namespace ncvet {
namespace {

class MotionRapidPlunge final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      return;
    const MachineProfile &machine = to.machine();
    top_ = machine.stock && machine.stock->max[2] ? machine.stock->max[2]
                                                  : machine.number("stockTopZ");
    wanted_ = to.flag("belowZero");
    if (top_ || wanted_ || !machine.clamps.empty())
      to.onMoves({MotionKind::Rapid});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    constexpr auto tool = uint16_t(1u << unsigned(Axis::Z));
    const Interval &from = ctx.before().at(Axis::Z), &to = ctx.after().at(Axis::Z);
    // With a stock it is the end that counts, wherever the tool comes from.
    const bool down =
        top_ || !ctx.machine().clamps.empty() ? (event.axes & tool) != 0 : event.axes == tool;
    if (!down || event.inMachineCoordinates() || !from.isConstant() || !to.isConstant() ||
        ctx.before().inMachineCoordinates(Axis::Z) || ctx.after().inMachineCoordinates(Axis::Z) ||
        to.value() >= from.value() || ctx.before().may(Fact::UnknownCode))
      return;
    if (intoClamp(event, ctx) || (!top_ && (!wanted_ || event.axes != tool)))
      return;
    const double top = top_.value_or(0);
    if (to.value() >= top || from.value() < top || besideStock(ctx))
      return;
    if (!top_ && !cutsAcross(ctx))
      return;
    if (auto finding = ctx.report(event, top_.has_value()))
      finding.message("this rapid move ends {0} mm below {1}: the tool goes into the work at full "
                      "speed",
                      shortNumber(top - to.value()), top_ ? "the top of the stock" : "zero");
  }

private:
  /// The path down leads through a clamp.
  static bool intoClamp(const Event &event, RuleContext &ctx) {
    if (!ctx.after().frames.empty() || ctx.before().machineAxes || ctx.after().machineAxes ||
        llvm::none_of(ctx.machine().clamps, [&](const Stock &clamp) {
          return leadsThrough(clamp, ctx.before().position, ctx.after().position) == Truth::Yes;
        }))
      return false;
    if (auto finding = ctx.report(event))
      finding.message("this rapid move leads down into a clamp of the machine profile");
    return true;
  }

  /// The tool comes down where the stock certainly is not.
  static bool besideStock(const RuleContext &ctx) {
    if (!ctx.machine().stock || !ctx.after().frames.empty())
      return false;
    const Stock &stock = *ctx.machine().stock;
    for (size_t i = 0; i < 2; ++i) {
      const Interval &at = ctx.after().position[i];
      if ((stock.min[i] && at.hi <= *stock.min[i]) || (stock.max[i] && at.lo >= *stock.max[i]))
        return true;
    }
    return false;
  }

  /// Without a stock: the tool comes up again from there, so that it has not gone past the part.
  static bool cutsAcross(RuleContext &ctx) {
    Block next;
    if (!readNext(ctx, next))
      return false;
    return !(axesOf(ctx.dialect(), next) & (1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y)));
  }

  std::optional<double> top_;
  bool wanted_ = false;
};

} // namespace
NCVET_RULE(MotionRapidPlunge, motion_rapid_plunge)
} // namespace ncvet
