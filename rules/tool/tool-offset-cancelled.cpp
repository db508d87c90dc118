// Work with a tool whose offset is cancelled.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/retracted_offset.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct ToolOffsetCancelledMemory {
  OncePerCause once;
};

class ToolOffsetCancelled final : public StatefulRule<ToolOffsetCancelledMemory> {
public:
  void listen(Subscriptions &to) override {
    edges_ = to.dialect().facts->tools.cuttingEdges;
    anyDigits_ = to.dialect().facts->tools.anyDigits;
    length_ = to.dialect().lengthByTool != noGroup;
    retracts_ = to.flag("retracts", true);
    if (to.dialect().isLathe() || edges_ || length_)
      to.onChange({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    if (length_)
      return withoutLength(event, ctx);
    if (edges_) {
      withoutEdge(event, ctx);
      return;
    }
    // A machine position needs no offset, nor does the reference point.
    if (state.toolOffset != 0 || state.tool <= 0 || event.inMachineCoordinates() ||
        event.motion == MotionKind::Reference || event.code == noCode ||
        ctx.before().toolOffset != 0)
      return sleepInShape();
    // Having cut, the tool may go home without it.
    const bool rapid = event.kind == EventKind::Motion && event.motion == MotionKind::Rapid;
    if (rapid && ctx.before().may(Fact::CutSinceTool))
      return;
    if (!memory().once.speaks(state.origin.of(StatePart::Tool), ctx))
      return;
    const bool slip = isSlip(state.tool, ctx) && goesOnToCut(ctx);
    if (!slip && anyDigits_ && isShort(ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding.severity(slip ? std::optional(Severity::Warning) : std::nullopt)
          .message("tool {0} moves without an offset: its length, nose radius and tip are missing",
                   int(state.tool))
          .note(state.origin.of(StatePart::Tool), "the tool is called here");
  }

private:
  /// `T04`: whether the machine takes it for the station or for the offset is a setting of it.
  static bool isShort(const RuleContext &ctx) {
    const Origin &call = ctx.after().origin.of(StatePart::Tool);
    if (!isHere(ctx, call))
      return false;
    Block block;
    readBlockOf(ctx, call, block);
    const Word *const word = block.find(letterAddress('T'));
    constexpr size_t digits = 2;
    return word && block.endOf(*word) - word->offset <= digits + 1;
  }

  /// Other stations of the file are called with the offsets of their own numbers, this one never.
  static bool isSlip(int32_t tool, const RuleContext &ctx) {
    constexpr unsigned habit = 2; // stations
    unsigned own = 0;
    for (const ProgramInfo &program : ctx.index().programs())
      for (const Block &block : blocksWith(ctx.index(), program, maskOf(letterAddress('T')))) {
        const Word *const word = block.find(letterAddress('T'));
        if (!word || !word->isNumber() || word->value() < 100 || word->value() > 9999)
          continue;
        const auto whole = int32_t(word->value());
        if (whole / 100 == tool && whole % 100 != 0)
          return false;
        own += whole / 100 == whole % 100;
      }
    return own >= habit;
  }

  /// The next moves cut, before another tool or offset is called.
  static bool goesOnToCut(const RuleContext &ctx) {
    constexpr unsigned furthest = 12; // blocks
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next) && !next.has(letterAddress('T')); ++i)
      if (findCode(ctx.dialect(), next,
                   {Action::Linear, Action::ArcCw, Action::ArcCcw, Action::Thread, Action::Cycle}))
        return true;
    return false;
  }

  /// The length of the tool is switched off, and its axis moves.
  void withoutLength(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const GroupIndex group = ctx.dialect().lengthByTool;
    const auto tool = uint16_t(1u << unsigned(toolAxis(ctx.dialect(), state)));
    if (!(event.axes & tool) || event.kind != EventKind::Motion || event.inMachineCoordinates() ||
        state.may(Fact::UnknownCode))
      return;
    for (const CodeIndex member : ctx.dialect().groups[group].members) {
      const CodeInfo &code = ctx.dialect().codes[member];
      if (code.action != Action::LengthOff || state.group(group) != uint64_t(1) << code.bit ||
          !memory().once.speaks(state.origin.ofGroup(group), ctx))
        continue;
      if (auto finding = ctx.report(ctx.blockRange(), event.certain))
        finding
            .message("`{0}` has switched the length of the tool off: this height is that of the "
                     "spindle",
                     code.name)
            .note(state.origin.ofGroup(group), "it is switched off here");
    }
  }

  /// D is length and radius: with D0 the tool has none.
  void withoutEdge(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.before();
    if (isRetractOfWork(event, ctx)) {
      if (auto finding = ctx.report(ctx.blockRange(), event.certain))
        finding.message("D0 takes the length of the tool off, and this height is one of the work: "
                        "the other retracts of the file with D0 are in machine coordinates");
      return;
    }
    if (leadsDown(event, ctx)) {
      if (auto finding = ctx.report(ctx.blockRange(), event.certain))
        finding.severity(Severity::Warning)
            .message("D0 takes the length of the tool off, and the block leads down to a height of "
                     "the work: the tool goes deeper by its length");
      return;
    }
    const bool cuts = event.kind == EventKind::CycleRun ||
                      (event.motion != MotionKind::Rapid && event.motion != MotionKind::Reference);
    const bool turret = isTurretWithoutEdge(ctx);
    const bool empty = !turret && ctx.after().tool == 0;
    if (cuts && !retracts_ && !empty && event.kind == EventKind::Motion &&
        isOfRetract(ctx, ctx.after().origin.of(StatePart::RadiusOffset)))
      return; // tool-length-offset-missing speaks
    if (cuts && !empty && event.kind == EventKind::CycleRun && isOfToolBefore(ctx))
      return;
    if (!cuts || event.inMachineCoordinates() || (ctx.after().radiusOffset != 0 && !empty) ||
        state.may(Fact::UnknownCode) || !(turret || state.must(Fact::ToolCalled)) ||
        !memory().once.speaks(
            ctx.after().origin.of(empty ? StatePart::Tool : StatePart::RadiusOffset), ctx))
      return;
    if (empty) {
      if (auto finding = ctx.report(ctx.blockRange(), event.certain))
        finding.message("the spindle is empty here: T0 has put the tool away")
            .note(ctx.after().origin.of(StatePart::Tool), "T0 is changed in here");
      return;
    }
    if (auto finding = ctx.report(ctx.blockRange(), event.certain)) {
      finding.message("the tool cuts with D0: neither its length nor its radius is in force")
          .note(ctx.after().origin.of(StatePart::RadiusOffset), "D0 is programmed here");
      if (event.kind == EventKind::Motion)
        finding.severity(Severity::Warning);
    }
  }

  /// `T11 D0` of a turret, which a T alone turns.
  static bool isTurretWithoutEdge(const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Origin &off = state.origin.of(StatePart::RadiusOffset);
    if (state.must(Fact::ToolCalled) || state.preselected == notSet || state.radiusOffset != 0 ||
        !turnsWork(ctx.dialect(), state) || !isHere(ctx, off))
      return false;
    Block block;
    readBlockOf(ctx, off, block);
    return isWithoutEdge(block) && block.has(letterAddress('T'));
  }

  /// A work offset is in force, and none that is the machine's own zero.
  static bool namesZeroPoint(const RuleContext &ctx) {
    const GroupIndex group = ctx.dialect().group(StandardGroup::WorkOffset);
    if (group == noGroup || !ctx.after().mayBeStated(group))
      return false;
    const GroupInfo &offsets = ctx.dialect().groups[group];
    const CodeInfo *const code = ctx.after().activeCode(ctx.dialect(), StandardGroup::WorkOffset);
    return code && code->action == Action::WorkOffset &&
           (offsets.initial >= offsets.members.size() ||
            code != &ctx.dialect().codes[offsets.members[offsets.initial]]);
  }

  /// A rapid move down the tool's axis with D0 in its block, in a work offset, to its zero or
  /// lower.
  static bool leadsDown(const Event &event, const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    if (event.kind != EventKind::Motion || event.motion != MotionKind::Rapid ||
        event.inMachineCoordinates() || ctx.before().radiusOffset == 0 || state.tool == 0 ||
        !isWithoutEdge(ctx.block()) || !ctx.before().may(Fact::CutSinceTool) ||
        ctx.find({Action::ToolChange}) || state.may(Fact::UnknownCode) ||
        turnsWork(ctx.dialect(), state))
      return false;
    const Axis tool = toolAxis(ctx.dialect(), state);
    const Interval &from = ctx.before().at(tool), &to = state.at(tool);
    return namesZeroPoint(ctx) && from.isConstant() && to.isConstant() && to.value() <= 0 &&
           to.value() < from.value() && !ctx.before().inMachineCoordinates(tool);
  }

  /// A rapid move along the tool with D0 in its block, to a height of the work, where all others of
  /// the file go to one of the machine.
  static bool isRetractOfWork(const Event &event, const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Axis tool = toolAxis(ctx.dialect(), state);
    if (event.kind != EventKind::Motion || event.motion != MotionKind::Rapid ||
        event.inMachineCoordinates() || !(event.axes >> unsigned(tool) & 1) ||
        !isWithoutEdge(ctx.block()) || ctx.before().radiusOffset == 0 || state.tool == 0 ||
        ctx.find({Action::ToolChange}) || state.may(Fact::UnknownCode))
      return false;
    constexpr unsigned habit = 2; // retracts
    unsigned others = 0;
    for (const ProgramInfo &program : ctx.index().programs())
      for (const Block &block : blocksWith(ctx.index(), program, maskOf(letterAddress('D')))) {
        if (block.begin == ctx.block().begin || !isWithoutEdge(block) ||
            !axesOf(ctx.dialect(), block))
          continue;
        if (!findCode(ctx.dialect(), block, {Action::MachineMove}))
          return false;
        ++others;
      }
    return others >= habit;
  }

  static bool isWithoutEdge(const Block &block) {
    const Word *const edge = block.find(letterAddress('D'));
    return edge && edge->isNumber() && edge->value() == 0;
  }

  /// A retract switched the edge of the tool before off: the change has brought the new one's
  /// first.
  static bool isOfToolBefore(const RuleContext &ctx) {
    const Origin &off = ctx.before().origin.of(StatePart::RadiusOffset);
    const Origin &tool = ctx.before().origin.of(StatePart::Tool);
    return off.known() && tool.known() && off.file == tool.file && off.begin < tool.begin &&
           isOfRetract(ctx, off);
  }

  bool anyDigits_ = false; ///< the machine says how the digits of T are split
  bool edges_ = false;
  bool length_ = false;  ///< a code switches the length off alone
  bool retracts_ = true; ///< D0 of a retract is this rule's
};

} // namespace
NCVET_RULE(ToolOffsetCancelled, tool_offset_cancelled)
} // namespace ncvet
