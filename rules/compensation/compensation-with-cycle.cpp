// A drilling or threading cycle, or a thread, while radius compensation is on.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CompensationWithCycle final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::CycleStart, EventKind::CycleRun, EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode ||
        (event.kind == EventKind::Motion && event.motion != MotionKind::Thread))
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.action == Action::Cycle && !forbidden(code.cycle))
      return;
    const Truth active = ctx.after().compensationActive(ctx.dialect());
    if (active == Truth::No || !ctx.after().origin.compensation.known())
      return;
    const CodeUse *use = nullptr;
    for (const CodeUse &each : ctx.codes())
      if (each.code == event.code)
        use = &each;
    const SourceRange where = use ? ctx.range(*use->word) : ctx.blockRange();
    if (auto finding = ctx.report(where, active == Truth::Yes && event.certain)) {
      const CodeInfo *on = ctx.after().activeCode(ctx.dialect(), StandardGroup::Compensation);
      const bool thread = code.action == Action::Thread || code.cycle == CycleKind::ThreadPass ||
                          code.cycle == CycleKind::ThreadMulti;
      finding
          .message(thread ? "`{0}` cuts a thread while {1} is on: the control stops, or the thread "
                            "is displaced"
                          : "`{0}` while {1} is on: the hole is not made, or in another place",
                   code.name, on ? "`" + on->name + "`" : std::string("compensation"))
          .note(ctx.after().origin.compensation, "compensation is switched on here")
          .fix(FixSafety::Unsafe, "insert `G40` before this block", ctx.insertBlockBefore("G40"));
    }
  }

private:
  static bool forbidden(CycleKind cycle) {
    switch (cycle) {
    case CycleKind::None:
    case CycleKind::TurnPass:
    case CycleKind::FacePass:
    case CycleKind::RoughTurn:
    case CycleKind::RoughFace:
    case CycleKind::PatternRepeat:
    case CycleKind::Finish:
      return false;
    default:
      return true;
    }
  }
};

} // namespace
NCVET_RULE(CompensationWithCycle, compensation_with_cycle)
} // namespace ncvet
