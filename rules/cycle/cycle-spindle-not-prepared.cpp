// A cycle needs something of the spindle that the machine does not have or that was not prepared.
#include "analyzer/facts/blocks_since.h"
#include "analyzer/facts/called_blocks.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/project.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CycleSpindleNotPrepared final : public Rule {
  static constexpr llvm::StringLiteral id = "cycle-spindle-not-prepared";

public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    // Tapping by a move: the spindle follows the axis, and nothing in the code orients it.
    if (to.dialect().orientWords)
      to.onCode([](const CodeInfo &code) { return tapsByMove(code); });
    tapDirectly_ = to.flag("tapDirectly");
    for (size_t i = 0; i < to.dialect().groups.size(); ++i)
      if (to.dialect().groups[i].id == "tapping-mode")
        tapping_ = GroupIndex(i);
    if (tapDirectly_ && tapping_ != noGroup)
      to.onCode([](const CodeInfo &code) { return tapsByCycle(code); });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (tapDirectly_ && tapping_ != noGroup && tapsByCycle(code)) {
      between(event, ctx);
      neverPrepared(event, code, ctx);
    }
    if (!ctx.dialect().orientWords || !tapsByMove(code) ||
        ctx.after().may(Fact::OrientedSinceTool) || ctx.after().may(Fact::UnknownCode))
      return;
    // Told at the first move; the retract from the thread says nothing new.
    const CodeInfo *motion = ctx.before().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (motion && tapsByMove(*motion))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` couples the spindle to the axis, and no {1} has positioned it",
                      code.name, ctx.dialect().alternatives(ctx.dialect().orientWords));
  }

private:
  static bool tapsByCycle(const CodeInfo &code) {
    return code.action == Action::Cycle && taps(code.cycle);
  }

  /// A tool that taps with neither a speed nor a start of its own: the spindle is stopped since the
  /// tool before.
  static void neverPrepared(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Origin &tool = state.origin.of(StatePart::Tool);
    const Origin &speed = state.origin.of(StatePart::Speed);
    const Origin &spindle = state.origin.of(StatePart::Spindle);
    if (code.spindle != SpindleNeed::Any || state.spindle != spindleOff ||
        state.may(Fact::UnknownCode) || !tool.known() || !speed.known() || !spindle.known() ||
        tool.file != speed.file || speed.begin >= tool.begin)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("`{0}` taps while the spindle is stopped, and this tool has no speed",
                   ctx.text(*event.word))
          .note(spindle, "the spindle is stopped here")
          .note(tool, "the tool is changed here");
  }

  /// Moves and speeds between the code that prepares rigid tapping and its cycle.
  void between(const Event &event, RuleContext &ctx) const {
    const Origin &origin = ctx.before().origin.ofGroup(tapping_);
    if (!origin.known())
      return;
    SourceRange moved;
    bool certain = event.certain;
    const auto look = [&](const FileUnit &unit, const Block &block) {
      // The spindle is free again: another code prepares the next cycle.
      if (block.hasLabel() || findCode(ctx.dialect(), block, {Action::CycleCancel, Action::Cycle}))
        return false;
      if (!moved.end && block.hasAny(ctx.dialect().axisWords | maskOf(letterAddress('S')))) {
        moved = {unit.source.id(), block.begin, block.next};
        certain &= block.skip < 0;
      }
      if (!moved.end && &unit == &ctx.unit() && movesInCall(block, ctx))
        moved = {unit.source.id(), block.begin, block.next};
      return true;
    };
    if (!blocksSince(origin, ctx, look) || !moved.end)
      return;
    if (auto finding = ctx.report(event, certain))
      finding
          .message("`{0}` does not come directly after `{1}`: a move or a speed between them makes "
                   "the control stop",
                   ctx.text(*event.word), ctx.text(origin.range()))
          .severity(Severity::Error)
          .note(origin, "rigid tapping is prepared here");
  }

  /// A program that the block calls moves or gives a speed, and prepares and taps nothing itself.
  bool movesInCall(const Block &block, const RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    if (block.skip >= 0 ||
        (!findCode(dialect, block, {Action::CallProgram}) && !entersProgram(block)))
      return false;
    constexpr unsigned most = 200; // blocks
    bool moves = false;
    unsigned read = 0;
    eachCalledBlock(ctx.unit(), block, [&](const Block &called) {
      const bool plain =
          ++read <= most && called.items.empty() && called.skip < 0 && !called.hasLabel() &&
          !findCode(dialect, called, {Action::CycleCancel, Action::Cycle}) &&
          llvm::none_of(codesOf(dialect, called),
                        [&](CodeIndex code) { return dialect.codes[code].group == tapping_; });
      moves = plain && called.hasAny(dialect.axisWords | maskOf(letterAddress('S')));
      return plain && !moves;
    });
    return moves;
  }

  static bool tapsByMove(const CodeInfo &code) {
    return code.action == Action::Thread && code.spindle == SpindleNeed::StartsItself;
  }

  bool tapDirectly_ = false;     ///< nothing may move between the code and its cycle
  GroupIndex tapping_ = noGroup; ///< of the code that prepares rigid tapping
};

} // namespace
NCVET_RULE(CycleSpindleNotPrepared, cycle_spindle_not_prepared)
} // namespace ncvet
