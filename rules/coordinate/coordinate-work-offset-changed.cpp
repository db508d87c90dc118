// Another work offset is selected after the tool has cut.
#include "analyzer/facts/cause_place.h"

namespace ncvet {
namespace {

class CoordinateWorkOffsetChanged final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onAction({Action::WorkOffset}); }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    const CodeInfo *const active = before.activeCode(ctx.dialect(), StandardGroup::WorkOffset);
    if (!before.must(Fact::Cut) || !before.must(Fact::WorkOffsetStated) || !active ||
        active->name == ctx.code(event).name || before.may(Fact::UnknownCode))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("`{0}` takes another zero point than `{1}`, with which the part was begun",
                   ctx.code(event).name, active->name)
          .note(before.originOf(ctx.dialect(), StandardGroup::WorkOffset),
                "the other one is selected here");
  }
};

} // namespace
NCVET_RULE(CoordinateWorkOffsetChanged, coordinate_work_offset_changed)
} // namespace ncvet
