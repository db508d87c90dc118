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
    if (wanted_)
      to.on(EventKind::CycleStart);
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      return;
    }
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
  bool wanted_ = false;
};

} // namespace
NCVET_RULE(CyclePlaneOrAxis, cycle_plane_or_axis)
} // namespace ncvet
