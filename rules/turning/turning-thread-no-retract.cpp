// A single thread stroke is not followed by a retract at rapid.
#include "analyzer/lookahead.h"

namespace ncvet {
namespace {

constexpr uint16_t xBit = 1u << unsigned(Axis::X), zBit = 1u << unsigned(Axis::Z);

class TurningThreadNoRetract final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &before = ctx.before();
    if (before.activeAction(ctx.dialect(), StandardGroup::Motion) != Action::Thread)
      return;
    // The stroke before: a thread on a face runs along X and retracts in Z, and one that moves both
    // axes may be the run-out.
    Block stroke;
    if (!readPrevious(ctx, stroke))
      return;
    const uint16_t along = axesOf(ctx.dialect(), stroke);
    if ((along & (xBit | zBit)) != zBit)
      return;
    if (event.motion == MotionKind::Thread && !hasMotionCode(ctx.dialect(), ctx.block()) &&
        (event.axes & (xBit | zBit)) == xBit) {
      const SourceRange range = ctx.blockRange();
      if (auto finding = ctx.report(range, event.certain))
        finding
            .message("`{0}` is cut as a thread: `{1}` of line {2} is still active", ctx.text(range),
                     ctx.code(event).name,
                     lineOf(ctx, before.originOf(ctx.dialect(), StandardGroup::Motion)))
            .note(before.originOf(ctx.dialect(), StandardGroup::Motion),
                  ctx.code(event).name + " becomes active here")
            .fix(FixSafety::Unsafe, "insert G00 in front of it",
                 ctx.insertBefore(range.begin, "G00 "));
    } else if (event.motion == MotionKind::Rapid && (event.axes & (xBit | zBit)) == zBit &&
               event.number == 0) {
      if (auto finding = ctx.report(ctx.blockRange(), event.certain))
        finding
            .message(
                "the tool goes back in Z at the depth of the thread: it was not retracted in X")
            .note(SourceRange{ctx.source().id(), stroke.begin, stroke.end},
                  "the thread is cut here");
    }
  }
};

} // namespace
NCVET_RULE(TurningThreadNoRetract, turning_thread_no_retract)
} // namespace ncvet
