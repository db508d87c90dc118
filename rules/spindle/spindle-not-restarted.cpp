// A cut behind rigid tapping, which has left the spindle standing.
#include "analyzer/once.h"

namespace ncvet {
namespace {

class SpindleNotRestarted final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onChange({EventKind::Motion, EventKind::CycleRun}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode || !ctx.before().may(Fact::SpindleStoppedByTap) ||
        !ctx.after().may(Fact::SpindleStoppedByTap) || ctx.before().profile == 1)
      return;
    const CodeInfo &code = ctx.code(event);
    if (event.kind == EventKind::Motion) {
      if (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
          event.motion == MotionKind::Skip || event.number == 1)
        return;
    } else if (code.spindle == SpindleNeed::StartsItself || code.spindle == SpindleNeed::Any ||
               code.cycle == CycleKind::RigidTap || code.cycle == CycleKind::RigidTapLeft ||
               code.cycle == CycleKind::Tap || code.cycle == CycleKind::TapLeft) {
      return;
    }
    const bool certain = event.certain && ctx.before().must(Fact::SpindleStoppedByTap);
    if (!certain && ctx.before().may(Fact::UnknownCode))
      return;
    if (!once_.speaks(ctx.before().origin.cycle, ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), certain)) {
      finding
          .message("`{0}` cuts behind rigid tapping: the tapping cycle has stopped the spindle and "
                   "nothing starts it again",
                   code.name)
          .note(ctx.before().origin.cycle, "the tapping cycle is called here");
      for (const CodeInfo &start : ctx.dialect().codes)
        if (start.action == Action::SpindleCw) {
          finding.fix(FixSafety::Unsafe, "insert `" + start.name + "` before this block",
                      ctx.insertBlockBefore(start.name));
          break;
        }
    }
  }

private:
  OncePerCause once_;
};

} // namespace
NCVET_RULE(SpindleNotRestarted, spindle_not_restarted)
} // namespace ncvet
