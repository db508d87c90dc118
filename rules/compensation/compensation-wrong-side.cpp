// Nose radius compensation on the side of the material.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CompensationWrongSide final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      to.on(EventKind::Motion);
  }

  /// Looks at the first element behind the entry. Cut towards the chuck, an outside contour grows
  /// and a bore shrinks; only when the entry came from the same side is it taken for certain.
  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const bool cuts = event.motion == MotionKind::Feed || event.motion == MotionKind::ArcCw ||
                      event.motion == MotionKind::ArcCcw;
    if (!cuts || event.code == noCode || before.compensation != phaseOn ||
        after.compensation != phaseOn || before.may(Fact::CompensatedCut) || event.number == 1 ||
        before.may(Fact::UnknownCode))
      return;
    const uint16_t plane = uint16_t(1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z));
    if (planeAxes(ctx.dialect(), after) != plane)
      return;
    for (const Axis axis : {Axis::X, Axis::Z})
      if (before.inMachineCoordinates(axis) || after.inMachineCoordinates(axis))
        return;
    const Interval dz = after.at(Axis::Z) - before.at(Axis::Z);
    const Interval dx = after.at(Axis::X) - before.at(Axis::X);
    if (!(dz.hi < 0) || !(before.at(Axis::X).lo >= 0) || !(after.at(Axis::X).lo >= 0))
      return;
    const bool outside = dx.lo > 0 && before.must(Fact::EnteredInward);
    const bool bore = dx.hi < 0 && before.must(Fact::EnteredOutward);
    if (!outside && !bore)
      return;
    const CodeInfo *code = after.activeCode(ctx.dialect(), StandardGroup::Compensation);
    const Action right = outside ? Action::CompensationRight : Action::CompensationLeft;
    if (!code || code->action == right ||
        (code->action != Action::CompensationLeft && code->action != Action::CompensationRight))
      return;
    const Origin &origin = after.origin.compensation;
    const bool here = origin.known() && origin.file == ctx.source().id();
    if (auto finding = ctx.report(here ? origin.range() : ctx.blockRange(), event.certain))
      finding
          .message("`{0}` on {1} cut towards the chuck: the nose runs on the side of the material, "
                   "`{2}` belongs there",
                   code->name, outside ? "an outside contour" : "a bore",
                   nameOf(right, ctx.dialect()))
          .note(ctx.blockRange(), outside ? "here the contour grows" : "here the bore shrinks");
  }

private:
  static std::string nameOf(Action action, const Dialect &dialect) {
    for (const CodeInfo &code : dialect.codes)
      if (code.action == action)
        return code.name;
    return "the other side";
  }
};

} // namespace
NCVET_RULE(CompensationWrongSide, compensation_wrong_side)
} // namespace ncvet
