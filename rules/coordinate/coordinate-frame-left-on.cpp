// A shift, rotation, scaling, mirror or polar mode is still on at the end of the program.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/switch_left_on.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class CoordinateFrameLeftOn final : public LeftOnRule {
public:
  CoordinateFrameLeftOn() : LeftOnRule(id) {}
  void listen(Subscriptions &to) override {
    LeftOnRule::listen(to);
    if (to.dialect().facts->program.modesOutliveReturn)
      to.on(EventKind::Return);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Return)
      atReturn(event, ctx);
    else if (event.kind != EventKind::ToolChange || !isShiftedAnew(ctx))
      LeftOnRule::on(event, ctx);
  }

private:
  /// A local shift alone is on, and before the new tool goes to any place another one is set.
  static bool isShiftedAnew(const RuleContext &ctx) {
    constexpr unsigned furthest = 12; // blocks
    const Dialect &dialect = ctx.dialect();
    for (unsigned i = 0; i < dialect.switches.size() && i < maxSwitches; ++i)
      if (dialect.switches[i].atToolChange && dialect.switches[i].leftOn == id &&
          dialect.switches[i].id != "local-zero" && ctx.before().switchMayBeOn(i))
        return false;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
      if (findCode(dialect, next, {Action::LocalShift}))
        return true;
      if (namesAxes(dialect, next) &&
          !findCode(dialect, next, {Action::ReferenceReturn, Action::MachineMove}))
        return false;
    }
    return false;
  }

  static constexpr llvm::StringLiteral id{"coordinate-frame-left-on"};
  /// A called program returns with a frame that it has switched on itself, and its caller goes on
  /// in it.
  static void atReturn(const Event &event, RuleContext &ctx) {
    if (ctx.callDepth() == 0 || ctx.after().may(Fact::UnknownCode))
      return;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (unsigned i = 0; i < ctx.dialect().switches.size() && i < maxSwitches; ++i) {
      const SwitchInfo &info = ctx.dialect().switches[i];
      const Origin &origin = ctx.after().origin.ofSwitch(i);
      if (info.leftOn != id || !ctx.after().switchMustBeOn(i) || !isIn(ctx, origin, program))
        continue;
      if (auto finding = ctx.report(event, event.certain))
        finding.severity(info.severity)
            .message("the program returns with {0} still on, which it has switched on itself",
                     info.title)
            .note(origin, info.title + " is switched on here");
    }
  }
};

} // namespace
NCVET_RULE(CoordinateFrameLeftOn, coordinate_frame_left_on)
} // namespace ncvet
