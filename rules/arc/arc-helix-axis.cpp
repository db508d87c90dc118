// An arc with an axis outside of its plane, where the control does not say what becomes of it or
// cannot compensate it.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ArcHelixAxis final : public Rule {
public:
  void listen(Subscriptions &to) override {
    wanted_ = to.dialect().facts->arcs.checksHelixAxis;
    compensated_ = to.dialect().facts->arcs.noHelixInNewPlane;
    if (wanted_ || compensated_)
      to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    if (event.code == noCode || event.inMachineCoordinates() || !event.certain ||
        !(event.axes & ~plane) ||
        ctx.after().active(ctx.dialect(), StandardGroup::Plane) == groupUnset)
      return;
    const bool turned = compensated_ && turnsUnderCompensation(ctx);
    if (!wanted_ && !turned)
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if ((address.kind != AddressKind::Axis && address.kind != AddressKind::Increment) ||
          (plane >> unsigned(address.axis) & 1))
        continue;
      if (auto finding = ctx.report(word)) {
        if (turned)
          finding.severity(Severity::Error)
              .message("`{0}` makes a helix whose axis is not that of the tool's infeed: it cannot "
                       "be compensated",
                       ctx.text(word))
              .note(ctx.before().origin.of(StatePart::Compensation),
                    "compensation is switched on here");
        else
          finding.message("`{0}` lies outside of the plane of `{1}`: whether the axis moves along "
                          "with the arc is not stated",
                          ctx.text(word), ctx.code(event).name);
      }
      return;
    }
  }

private:
  /// The plane of the arc was selected while compensation was on already.
  static bool turnsUnderCompensation(const RuleContext &ctx) {
    const Origin plane = ctx.after().originOf(ctx.dialect(), StandardGroup::Plane);
    const Origin start = ctx.before().origin.of(StatePart::Compensation);
    return ctx.before().compensation == phaseOn && ctx.after().compensation == phaseOn &&
           plane.known() && start.known() && plane.file == start.file && plane.begin > start.begin;
  }

  bool wanted_ = false;      ///< the control does not say what a third axis does
  bool compensated_ = false; ///< it refuses a compensated helix in another plane
};

} // namespace
NCVET_RULE(ArcHelixAxis, arc_helix_axis)
} // namespace ncvet
