// A drilling cycle runs in a plane in which it does not work.
#include "analyzer/lookahead.h"

namespace ncvet {
namespace {

constexpr llvm::StringLiteral id = "cycle-plane-or-axis";

class CyclePlaneOrAxis final : public Rule {
public:
  void listen(Subscriptions &to) override {
    // A lathe that drills in a plane of its own; where G18 is the only plane there is no choice.
    const GroupIndex plane = to.dialect().group(StandardGroup::Plane);
    if (to.dialect().isLathe() && plane != noGroup && to.option("drillsUnderG17", 0) != 0)
      for (const CodeIndex member : to.dialect().groups[plane].members)
        wanted_ |= to.dialect().codes[member].action == Action::PlaneXY;
    setup_ = to.option("setup", 0) != 0;
    if (wanted_ || setup_)
      to.on(EventKind::CycleStart);
    if (setup_)
      to.on(EventKind::CycleRun);
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      return;
    }
    if (setup_)
      prepared(event, ctx);
    if (!wanted_)
      return;
    const CodeInfo &code = ctx.code(event);
    const MachineState &state = ctx.after();
    if (!makesHole(code.cycle) || state.active(ctx.dialect(), StandardGroup::Plane) == groupUnset ||
        state.isActive(ctx.dialect(), StandardGroup::Plane, {Action::PlaneZX}) != Truth::Yes)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("`{0}` drills while G18 is active: holes along Z need G17, holes along X G19",
                   code.name)
          .note(state.originOf(ctx.dialect(), StandardGroup::Plane), "G18 is selected here");
  }

private:
  /// Work offset, plane and dimensions are programmed in front of the first cycle.
  void prepared(const Event &event, RuleContext &ctx) {
    if (event.code == noCode || said_ || ctx.callDepth() > 0 ||
        ctx.before().may(Fact::UnknownCode) || !ctx.block().has(argumentAddress))
      return;
    std::string missing;
    for (const StandardGroup which :
         {StandardGroup::WorkOffset, StandardGroup::Plane, StandardGroup::Distance}) {
      const GroupIndex group = ctx.dialect().group(which);
      if (group == noGroup || (ctx.before().statedMay >> group & 1))
        continue;
      missing += missing.empty() ? "" : ", ";
      missing += ctx.dialect().groups[group].title;
    }
    said_ = true;
    if (missing.empty())
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` runs before the program has stated: {1}", ctx.code(event).name, missing)
          .severity(Severity::Warning);
  }

  bool setup_ = false, said_ = false;
  bool wanted_ = false;
};

} // namespace
NCVET_RULE(CyclePlaneOrAxis, cycle_plane_or_axis)
} // namespace ncvet
