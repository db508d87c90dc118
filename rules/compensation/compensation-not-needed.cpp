// Nose radius compensation around a path that runs parallel to the axes only.
#include "analyzer/facts/cause_place.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CompensationNotNeeded final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe()) // a mill's radius matters on every line
      to.onAction({Action::CompensationOff});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.before();
    const Origin &origin = state.origin.of(StatePart::Compensation);
    if (state.compensation != phaseOn || !state.must(Fact::CompensatedCut) ||
        state.may(Fact::ContourCompensated) || !origin.known())
      return;
    const uint16_t plane = uint16_t(1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z));
    if (planeAxes(ctx.dialect(), state) != plane)
      return;
    const CausePlace place = causePlace(ctx, origin, ctx.range(*event.word));
    if (auto finding = ctx.report(place.at))
      finding
          .message("compensation is on for moves parallel to the axes only: the nose radius does "
                   "nothing there")
          .note(place.other, place.note("it is switched off here", "it is switched on here"));
  }
};

} // namespace
NCVET_RULE(CompensationNotNeeded, compensation_not_needed)
} // namespace ncvet
