// The plane changed while radius compensation is on.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class CompensationPlaneChange final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::PlaneXY, Action::PlaneZX, Action::PlaneYZ});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const CodeInfo &code = ctx.code(event);
    const Dialect &dialect = ctx.dialect();
    const Truth was = ctx.before().compensationActive(dialect);
    const Truth is = ctx.after().compensationActive(dialect);
    if (was == Truth::No || is == Truth::No)
      return sleepInShape();
    if (!ctx.after().origin.of(StatePart::Compensation).known() || code.group == noGroup)
      return;
    const uint64_t planes = ctx.before().group(code.group), here = uint64_t(1) << code.bit;
    // Not stated so far: the machine's usual plane.
    if (planes == groupUnset) {
      const bool usual = code.action == (dialect.isLathe() ? Action::PlaneZX : Action::PlaneXY);
      if (usual)
        return;
    } else if (planes == here) {
      return;
    }
    const bool certain =
        was == Truth::Yes && is == Truth::Yes && planes != groupUnset && !(planes & here);
    if (auto finding = ctx.report(event, certain)) {
      const CodeInfo *on = ctx.before().activeCode(dialect, StandardGroup::Compensation);
      finding
          .message("`{0}` changes the plane while {1} is on: the control stops with an alarm",
                   code.name, on ? "`" + on->name + "`" : std::string("compensation"))
          .note(ctx.after().origin.of(StatePart::Compensation), "compensation is switched on here");
    }
  }
};

} // namespace
NCVET_RULE(CompensationPlaneChange, compensation_plane_change)
} // namespace ncvet
