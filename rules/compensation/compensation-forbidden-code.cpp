// Codes that must not be used while radius compensation is on.
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/preprocessor_reads.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/state/zero_point.h"

namespace ncvet {
namespace {

class CompensationForbiddenCode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::ReferenceReturn, Action::ReferenceCheck, Action::ReferenceFrom,
                 Action::DataInput, Action::LocalShift, Action::PresetPosition, Action::MachineMove,
                 Action::Inch, Action::Metric, Action::WorkOffset, Action::Thread, Action::Cycle,
                 Action::FrameSet, Action::FrameAdd, Action::FrameClear, Action::ZeroSet,
                 Action::ZeroHere});
    to.onCode([](const CodeInfo &code) { return code.stopsPreparation; });
    cycles_ = to.dialect().facts->compensation.forbidsCycles;
    if (to.dialect().readAhead.empty())
      return;
    to.on(EventKind::Statement);
    to.onChange({EventKind::Block});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind != EventKind::Code &&
        ctx.before().compensationActive(ctx.dialect()) == Truth::No)
      return sleepAtBlock();
    if (event.kind != EventKind::Code)
      return eachPrepared(event, ctx, [&](const Expression &value) { waits(value, ctx); });
    const CodeInfo &code = ctx.code(event);
    // `G40` in the same block comes first.
    const Truth active = ctx.after().compensationActive(ctx.dialect());
    if (active == Truth::No)
      return sleepInShape();
    if (!ctx.after().origin.of(StatePart::Compensation).known() || !disturbs(code, ctx) ||
        (outlivesTool(ctx.before()) && !turnsFrame(code)))
      return;
    const bool wasOn = ctx.before().compensationActive(ctx.dialect()) != Truth::No;
    // Switched on in this very block: a unit or an offset comes before the move.
    if (!wasOn && code.action != Action::Thread && code.action != Action::Cycle)
      return;
    if (auto finding = ctx.report(event, active == Truth::Yes)) {
      if (code.action == Action::ZeroSet || code.action == Action::ZeroHere)
        finding.severity(Severity::Error); // an interpreter that keeps its zero points itself
      const CodeInfo *on = ctx.after().activeCode(ctx.dialect(), StandardGroup::Compensation);
      const std::string off = compensationOffCode(ctx.dialect(), ctx.after());
      finding
          .message("`{0}` while {1} is on: the control stops, or shifts the contour under the tool",
                   code.name, on ? "`" + on->name + "`" : std::string("compensation"))
          .note(ctx.after().origin.of(StatePart::Compensation), "compensation is switched on here")
          .fix(FixSafety::Unsafe, "insert `" + off + "` before this block",
               ctx.insertBlockBefore(off));
    }
  }

private:
  /// To read an actual value the control waits for its own moves, as it does by a code.
  static void waits(const Expression &value, RuleContext &ctx) {
    const Truth active = ctx.before().compensationActive(ctx.dialect());
    const Origin &origin = ctx.before().origin.of(StatePart::Compensation);
    if (active == Truth::No || !origin.known() || !readsAhead(value, ctx, /*ofAxis=*/true))
      return;
    const SourceRange range = ctx.range(value);
    if (auto finding = ctx.report(range, active == Truth::Yes)) {
      const CodeInfo *on = ctx.before().activeCode(ctx.dialect(), StandardGroup::Compensation);
      finding
          .message("`{0}` while {1} is on: to read it the control waits for its moves, and loses "
                   "the offset path",
                   ctx.text(range), on ? "`" + on->name + "`" : std::string("compensation"))
          .note(origin, "compensation is switched on here");
    }
  }

  /// What each tool begins and ends with has the cause that was told at its change; a frame is a
  /// decision about the contour that follows.
  static bool turnsFrame(const CodeInfo &code) {
    return code.action == Action::FrameSet || code.action == Action::FrameAdd ||
           code.action == Action::FrameClear;
  }

  bool disturbs(const CodeInfo &code, RuleContext &ctx) const {
    switch (code.action) {
    case Action::Thread:
      return cycles_;
    case Action::ZeroSet:
    case Action::ZeroHere:
      return movesSystemInForce(ctx);
    case Action::WorkOffset: // the same once more changes nothing
      return code.group == noGroup || ctx.before().group(code.group) != (uint64_t(1) << code.bit);
    case Action::Cycle:
      return cycles_ && code.cycle != CycleKind::None && !turnsOrFaces(code.cycle);
    default:
      return true;
    }
  }

  /// Whether the P of the block names the work offset in force.
  static bool movesSystemInForce(RuleContext &ctx) {
    const Word *p = ctx.block().find('P');
    const Interval number = p ? ctx.value(*p) : Interval::unknown();
    const auto system = activeSystem(ctx.dialect(), ctx.before());
    return number.isConstant() &&
           (number.value() == 0 || (system && number.value() == *system + 1));
  }

  bool cycles_ = false;
};

} // namespace
NCVET_RULE(CompensationForbiddenCode, compensation_forbidden_code)
} // namespace ncvet
