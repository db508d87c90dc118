// A move along the tool axis after a tool change, before length compensation is on.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/retracted_offset.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <cstring>
#include <map>

namespace ncvet {
namespace {

struct ToolLengthOffsetMissingMemory {
  Aside<std::optional<int32_t>> onlyTool; ///< the first tool of a program without length offsets
  Aside<std::map<FileId, bool>> uses;     ///< by file: it names length offsets
  OncePerCause once;
  Origin measured; ///< the call of the tool that was driven against something since
};

class ToolLengthOffsetMissing final : public StatefulRule<ToolLengthOffsetMissingMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().group(StandardGroup::LengthOffset) != noGroup)
      to.onChange({EventKind::Motion, EventKind::CycleRun});
    stays_ = to.flag("changeStays");
    retracts_ = to.flag("retracts") && to.dialect().facts->tools.cuttingEdges;
    if (retracts_)
      to.onMoves({MotionKind::Feed, MotionKind::ArcCw, MotionKind::ArcCcw});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (retracts_)
      return afterRetract(event, ctx);
    const MachineState &state = ctx.after();
    const Axis tool = toolAxis(ctx.dialect(), state);
    if (event.kind == EventKind::Motion && event.motion == MotionKind::Skip)
      memory().measured = state.origin.of(StatePart::Tool);
    // Drilling goes along the tool axis in every hole.
    if (event.kind == EventKind::Motion && !(event.axes >> unsigned(tool) & 1))
      return sleepInShape();
    // In a plane for arcs only the tool still points along Z.
    if (event.kind == EventKind::Motion && !(event.axes >> unsigned(Axis::Z) & 1))
      return sleepInShape();
    const bool called = state.must(Fact::ToolCalled) || state.preselected > 0;
    // `M6 T0` leaves the spindle empty: nothing is too long.
    if (called && state.must(Fact::LengthSinceTool))
      return afterCancel(event, ctx);
    if (!called || (state.tool == 0 && state.preselected <= 0) ||
        state.must(Fact::LengthSinceTool) || event.code == noCode || event.inMachineCoordinates() ||
        event.motion == MotionKind::Reference || event.motion == MotionKind::Skip)
      return sleepInShape();
    if (event.kind == EventKind::CycleRun && cycleOutlivesTool(state))
      return; // the hole itself is not meant
    // Cancelled on purpose in this block, on the retract; up to the height of the change.
    if (ctx.find({Action::LengthOff}) || leadsUp(event, ctx) || staysThere(event, ctx))
      return;
    const bool certain =
        event.certain && !state.may(Fact::LengthSinceTool) && !state.may(Fact::UnknownCode);
    const Origin &origin = state.origin.of(StatePart::Tool);
    // `G43 H0`: where all tools have it, their lengths are in the zero point.
    const bool zero =
        state.lengthOffset == 0 &&
        state.isActive(ctx.dialect(), StandardGroup::LengthOffset,
                       {Action::LengthPositive, Action::LengthNegative}) == Truth::Yes;
    if (zero && !namesLengths(ctx))
      return;
    if (!memory().once.maySpeak(origin, ctx) || isMeasured(ctx) || isBeingMeasured(origin, state) ||
        !memory().once.speaks(origin, ctx))
      return;
    // A program that never speaks of length offsets may be for a machine without any, and with one
    // tool the zero is where this tool touched the work.
    const bool uses = programUsesOffsets(ctx) || namesOffset(ctx);
    std::optional<int32_t> &onlyTool = memory().onlyTool.look();
    const bool first = onlyTool.value_or(state.tool) == state.tool;
    if (!uses && !onlyTool)
      onlyTool = state.tool;
    if (auto finding = ctx.report(ctx.blockRange(), certain && uses)) {
      finding
          .message("the tool moves along its axis before its length offset is on: it goes too deep "
                   "by its length")
          .note(origin, "the tool is changed here");
      if (zero)
        finding.severity(Severity::Warning);
      else if (!uses)
        finding.severity(first ? Severity::Style : Severity::Warning);
    }
  }

private:
  /// `G43 H0 Z5.` after `G43 H1`, and the tool goes on down: the number of its offset was lost.
  static bool worksWithout(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const Word *const h = ctx.block().find(letterAddress('H'));
    if (before.lengthOffset <= 0 || after.lengthOffset != 0 || !h || !event.certain ||
        event.kind != EventKind::Motion || event.inMachineCoordinates() ||
        event.motion == MotionKind::Reference || before.may(Fact::UnknownCode) ||
        before.tool != after.tool || !ctx.find({Action::LengthPositive, Action::LengthNegative}) ||
        after.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Absolute}) != Truth::Yes ||
        !goesDown(ctx))
      return false;
    if (auto finding = ctx.report(*h))
      finding.severity(Severity::Warning)
          .message("`{0}` takes the length offset away, and the tool goes on down: it is deeper by "
                   "its length",
                   ctx.text(*h))
          .note(before.originOf(ctx.dialect(), StandardGroup::LengthOffset),
                "the offset is switched on here");
    return true;
  }

  /// The next block along Z leads lower, or drills.
  static bool goesDown(const RuleContext &ctx) {
    constexpr unsigned furthest = 6; // blocks
    const Word *const here = ctx.block().find(letterAddress('Z'));
    BlocksAhead ahead(ctx);
    Block block;
    for (unsigned i = 0; here && here->isNumber() && i < furthest && ahead.next(block); ++i) {
      if (findCode(ctx.dialect(), block,
                   {Action::ToolChange, Action::ReferenceReturn, Action::MachineMove,
                    Action::LengthPositive, Action::LengthOff, Action::ProgramEnd,
                    Action::ProgramEndRewind}))
        return false;
      const Word *const z = block.find(letterAddress('Z'));
      if (z)
        return z->isNumber() && z->value() < here->value();
    }
    return false;
  }

  /// `G49`, and with the same tool a move to a height that was meant for its tip.
  void afterCancel(const Event &event, RuleContext &ctx) const {
    if (worksWithout(event, ctx))
      return;
    const auto off = [&](const MachineState &state) {
      return state.isActive(ctx.dialect(), StandardGroup::LengthOffset, {Action::LengthOff}) ==
             Truth::Yes;
    };
    if (!off(ctx.after()))
      return sleepInShape();
    const Interval &to = ctx.after().at(Axis::Z);
    if (!off(ctx.before()) || event.kind != EventKind::Motion || event.inMachineCoordinates())
      return sleepInShape();
    // Where the lengths are below zero, and the zero point is the machine's, Z0 is the home.
    if (!to.isConstant() || to.value() <= 0)
      return;
    if (event.motion == MotionKind::Reference || event.motion == MotionKind::Skip ||
        event.code == noCode || ctx.find({Action::ToolChange}) ||
        ctx.after().may(Fact::UnknownCode) ||
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Absolute}) !=
            Truth::Yes) // an increment is the same with any length
      return;
    const Origin cancelled = ctx.after().originOf(ctx.dialect(), StandardGroup::LengthOffset);
    // Where the program switches none on, it cancels for safety what may be there.
    if (!cancelled.known() || !programUsesOffsets(ctx) || !memory().once.speaks(cancelled, ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding.severity(Severity::Warning)
          .message(
              "the tool moves along its axis after its length offset was cancelled: the end of "
              "the spindle goes to that height, and the tool is deeper by its length")
          .note(cancelled, "the offset is cancelled here");
  }

  /// Whether the file has an H other than 0.
  static bool namesLengths(const RuleContext &ctx) {
    for (const ProgramInfo &program : ctx.index().programs())
      for (const Block &block : blocksWith(ctx.index(), program, maskOf(letterAddress('H'))))
        if (const Word *const length = block.find(letterAddress('H'));
            length && length->isNumber() && length->value() != 0)
          return true;
    return false;
  }

  /// A word of the axis that says again where it is moves nothing along it.
  bool staysThere(const Event &event, const RuleContext &ctx) const {
    const Interval &from = ctx.before().at(Axis::Z);
    return stays_ && event.kind == EventKind::Motion && from.isConstant() &&
           from == ctx.after().at(Axis::Z);
  }

  /// The block of the change itself leads up, at rapid.
  static bool leadsUp(const Event &event, const RuleContext &ctx) {
    const Interval &from = ctx.before().at(Axis::Z), &to = ctx.after().at(Axis::Z);
    return event.motion == MotionKind::Rapid && ctx.find({Action::ToolChange}) &&
           from.isConstant() && to.isConstant() && to.value() > from.value();
  }

  bool stays_ = false;    ///< a tool change leaves the axes where they are
  bool retracts_ = false; ///< D0 takes the length away, and a retract has left it in force

  /// `SUPA G0 Z500 D0`, and a cut without D1.
  void afterRetract(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (event.inMachineCoordinates() || state.radiusOffset != 0 || state.tool == 0 ||
        !state.must(Fact::ToolCalled) || ctx.before().may(Fact::UnknownCode))
      return sleepInShape();
    const Origin &off = state.origin.of(StatePart::RadiusOffset);
    // A change of the tool takes its first edge by itself.
    const Origin &tool = state.origin.of(StatePart::Tool);
    if (tool.known() && tool.file == off.file && tool.begin > off.begin)
      return;
    if (!memory().once.maySpeak(off, ctx) || !isOfRetract(ctx, off) ||
        !memory().once.speaks(off, ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("the tool cuts with D0 of its retract: neither its length nor its radius is in "
                   "force")
          .note(off, "D0 is programmed here");
  }

  /// It was driven against something, and no spindle has turned since.
  bool isBeingMeasured(const Origin &tool, const MachineState &state) const {
    constexpr uint8_t turning = spindleCw | spindleCcw;
    return tool.known() && memory().measured == tool &&
           !(state.spindle && !(state.spindle & ~turning));
  }

  /// The tool goes to its setter: it is measured before it cuts anything.
  static bool isMeasured(const RuleContext &ctx) {
    constexpr unsigned furthest = 12; // blocks
    BlocksAhead ahead(ctx);
    Block block;
    for (unsigned i = 0; i < furthest && ahead.next(block); ++i) {
      if (findCode(ctx.dialect(), block, {Action::SkipMove}))
        return true;
      const bool along = !(axesOf(ctx.dialect(), block) & ~uint16_t(1u << unsigned(Axis::Z)));
      if (findCode(ctx.dialect(), block, {Action::Cycle, Action::ToolChange}) ||
          (!along && findCode(ctx.dialect(), block, {Action::Linear})))
        return false; // (down to its switch it is fed)
    }
    return false;
  }

  /// `Z10. H1`: the number of a length offset, and no code that switches it on.
  static bool namesOffset(const RuleContext &ctx) {
    return !ctx.dialect().offsetsOfTool && ctx.block().has(letterAddress('H')) &&
           !findCode(ctx.dialect(), ctx.block(), {Action::Cycle, Action::CallProgram});
  }

  /// Whether the file names a code of the length offset's group anywhere; looked up once a file.
  bool programUsesOffsets(RuleContext &ctx) const {
    const auto [entry, fresh] = memory().uses.look().try_emplace(ctx.source().id(), false);
    if (fresh) {
      const GroupIndex group = ctx.dialect().group(StandardGroup::LengthOffset);
      for (const CodeIndex member : ctx.dialect().groups[group].members) {
        const CodeInfo &code = ctx.dialect().codes[member];
        if (code.action == Action::LengthPositive || code.action == Action::LengthNegative)
          entry->second = entry->second || holds(ctx.source().text(), code.name);
      }
    }
    return entry->second;
  }

  /// The library's search goes from one first letter to the next, several times as fast as LLVM's,
  /// which matters in a long text.
  static bool holds(llvm::StringRef text, llvm::StringRef word) {
    for (const std::string &spelling : {word.str(), word.lower()})
      for (size_t at = text.find(spelling); at != llvm::StringRef::npos;
           at = text.find(spelling, at + 1)) {
        const llvm::StringRef before = text.take_front(at).rsplit('\n').second;
        if (before.count('(') <= before.count(')'))
          return true; // in no comment
      }
    return false;
  }
};

} // namespace
NCVET_RULE(ToolLengthOffsetMissing, tool_length_offset_missing)
} // namespace ncvet
