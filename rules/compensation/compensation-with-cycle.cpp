// A drilling or threading cycle, or a thread, while radius compensation is on.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <set>

namespace ncvet {
namespace {

struct CompensationWithCycleMemory {
  std::set<std::pair<FileId, uint32_t>> begun; ///< where cycles under compensation begin
};

class CompensationWithCycle final : public StatefulRule<CompensationWithCycleMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::CycleStart, EventKind::CycleRun, EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode ||
        (event.kind == EventKind::Motion && event.motion != MotionKind::Thread))
      return sleepInShape();
    const CodeInfo &code = ctx.code(event);
    if (code.action == Action::Cycle && !forbidden(code.cycle))
      return sleepInShape();
    const Truth active = ctx.after().compensationActive(ctx.dialect());
    if (active == Truth::No)
      return sleepInShape();
    if (active == Truth::No || !ctx.after().origin.of(StatePart::Compensation).known())
      return;
    if (((cutsThread(code.cycle) || !ctx.asked()) && outlivesTool(ctx.after())) ||
        (code.action == Action::Cycle && cycleOutlivesTool(ctx.after())))
      return;
    // Told where the cycle begins, not at each of its holes again.
    const Origin &origin = ctx.after().origin.of(StatePart::Cycle);
    if (code.action == Action::Cycle && origin.known()) {
      if (event.kind == EventKind::CycleStart)
        memory().begun.insert({origin.file, origin.begin});
      else if (memory().begun.count({origin.file, origin.begin}) && !writes(origin, ctx))
        return;
    }
    const CodeUse *use = nullptr;
    for (const CodeUse &each : ctx.codes())
      if (each.code == event.code)
        use = &each;
    const SourceRange where = use ? ctx.range(*use->word) : ctx.blockRange();
    if (auto finding = ctx.report(where, active == Truth::Yes && event.certain)) {
      const CodeInfo *on = ctx.after().activeCode(ctx.dialect(), StandardGroup::Compensation);
      const std::string off = compensationOffCode(ctx.dialect(), ctx.after());
      const bool thread = code.action == Action::Thread || cutsThread(code.cycle);
      finding
          .message(
              thread ? "`{0}` cuts a thread while {1} is on: the control stops, or the thread "
                       "is displaced"
              : mills(code.cycle)
                  ? "`{0}` while {1} is on: the control stops, or the cycle runs on another path"
                  : "`{0}` while {1} is on: the hole is not made, or in another place",
              code.name, on ? "`" + on->name + "`" : std::string("compensation"))
          .note(ctx.after().origin.of(StatePart::Compensation), "compensation is switched on here")
          .fix(FixSafety::Unsafe, "insert `" + off + "` before this block",
               ctx.insertBlockBefore(off));
    }
  }

private:
  /// Whether the current block is the one that makes the cycle active.
  static bool writes(const Origin &origin, const RuleContext &ctx) {
    return isHere(ctx, origin) && origin.begin >= ctx.block().begin &&
           origin.begin < ctx.block().end;
  }

  static bool mills(CycleKind cycle) {
    switch (cycle) {
    case CycleKind::Face:
    case CycleKind::Contour:
    case CycleKind::Pocket:
    case CycleKind::Slot:
    case CycleKind::ThreadMill:
    case CycleKind::Measure:
      return true;
    default:
      return false;
    }
  }

  static bool forbidden(CycleKind cycle) {
    return cycle != CycleKind::None && cycle != CycleKind::Surface && !turnsOrFaces(cycle);
  }
};

} // namespace
NCVET_RULE(CompensationWithCycle, compensation_with_cycle)
} // namespace ncvet
