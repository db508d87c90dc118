// Inch and metric are mixed, or the unit is selected after motion.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

struct CoordinateUnitChangedMemory {
  std::pair<Action, FileId> back{Action::None, 0}; ///< unit before the change that was reported
};

class CoordinateUnitChanged final : public StatefulRule<CoordinateUnitChangedMemory> {
public:
  void listen(Subscriptions &to) override { to.onAction({Action::Inch, Action::Metric}); }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    const GroupIndex group = ctx.dialect().group(StandardGroup::Units);
    if (group == noGroup || before.may(Fact::UnknownCode))
      return;
    const bool stated = before.isStated(group);
    const CodeInfo *active = before.activeCode(ctx.dialect(), StandardGroup::Units);
    const CodeInfo &code = ctx.code(event);
    if (active && active->action == code.action)
      return sleepInShape(); // says the same again
    if (stated) {
      if (!active)
        return;
    } else {
      // Selected for the first time: too late when the tool has been driven by numbers.
      const bool drove = before.must(Fact::Moved) &&
                         (before.must(Fact::Cut) || !before.may(Fact::AtMachinePosition));
      if (!drove || (before.mayBeStated(group)))
        return;
    }
    // The program has kept its modes, to bring them back.
    if (ctx.callDepth() > 0 && (before.saved.modes || !before.saved.known))
      return;
    // The change back belongs to the change that was reported.
    if (stated && memory().back == std::pair(code.action, ctx.source().id()))
      return;
    auto finding = ctx.report(event);
    if (!finding)
      return;
    if (stated)
      memory().back = {active->action, ctx.source().id()};
    if (stated)
      finding
          .message("`{0}` changes the unit: `{1}` was in force", ctx.text(*event.word),
                   active->name)
          .note(before.originOf(ctx.dialect(), StandardGroup::Units),
                "`" + active->name + "` becomes active here");
    else
      finding.message("`{0}` selects the unit after the tool has moved: the moves before it were "
                      "read in whatever unit was in force",
                      ctx.text(*event.word));
  }
};

} // namespace
NCVET_RULE(CoordinateUnitChanged, coordinate_unit_changed)
} // namespace ncvet
