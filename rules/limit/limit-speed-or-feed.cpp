// A spindle speed lies above the clamp that the program set.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class LimitSpeedOrFeed final : public Rule {
public:
  void listen(Subscriptions &to) override {
    always_ = to.dialect().facts->spindle.inRevolutions;
    to.on(EventKind::SpeedWord);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    if (event.limitsSpeed() || !state.must(Fact::SpeedLimitSet) || !state.speedLimit->isConstant())
      return;
    if (!always_ && (ctx.dialect().group(StandardGroup::SpeedMode) == noGroup ||
                     state.isActive(ctx.dialect(), StandardGroup::SpeedMode,
                                    {Action::ConstantSpeed}) != Truth::Yes))
      return;
    if (!(event.speed().lo > state.speedLimit->value()))
      return;
    if (auto finding = ctx.report(event))
      finding.message(
          "`{0}` lies above the speed limit of {1} 1/min: the spindle turns no faster than that",
          ctx.text(*event.word), state.speedLimit->value());
  }

private:
  bool always_ = false; ///< every S is a speed in revolutions
};

} // namespace
NCVET_RULE(LimitSpeedOrFeed, limit_speed_or_feed)
} // namespace ncvet
