// Incremental dimensions are still on when the program ends.
#include "analyzer/facts/block_before.h"
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct CoordinateIncrementalLeftOnMemory {
  bool saysAbsolute =
      false; ///< a program that never does may be meant to be incremental as a whole
};

class CoordinateIncrementalLeftOn final : public StatefulRule<CoordinateIncrementalLeftOnMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().group(StandardGroup::Distance) != noGroup &&
        to.dialect().facts->program.modesOutliveEnd)
      to.on({EventKind::ProgramEnd, EventKind::FlowIssue});
    if (to.dialect().group(StandardGroup::Distance) != noGroup &&
        to.dialect().facts->program.modesOutliveReturn)
      to.on(EventKind::Return);
    home_ = to.flag("afterHome");
    notAtEnd_ = !to.flag("atEnd");
    if (to.dialect().group(StandardGroup::Distance) != noGroup) {
      to.onChange({EventKind::CycleRun, EventKind::Motion});
      to.onAction({Action::Absolute});
      if (!to.dialect().isLathe())
        to.onAction({Action::WorkOffset});
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &state = ctx.after();
    if (event.kind == EventKind::Code && ctx.code(event).action == Action::WorkOffset)
      return atZeroPoint(event, ctx);
    if (event.kind == EventKind::Code) {
      memory().saysAbsolute = true;
      return;
    }
    if (event.kind == EventKind::CycleRun || event.kind == EventKind::Motion)
      return early(event, ctx);
    if (notAtEnd_ && !ctx.asked())
      return;
    if (event.kind == EventKind::Return)
      return atReturn(event, ctx);
    // A subprogram's end ends a main program too.
    if (event.kind == EventKind::FlowIssue &&
        (event.flowIssue() != FlowIssue::ReturnInMain ||
         ctx.index().programAt(ctx.block().begin).kind != ProgramKind::Main))
      return;
    // Where the end of a called program only returns, the caller goes on: another rule's matter.
    if (event.kind == EventKind::ProgramEnd && ctx.dialect().endReturns &&
        (ctx.callDepth() > 0 ||
         ctx.index().programAt(ctx.block().begin).kind == ProgramKind::Subprogram))
      return;
    if (state.active(ctx.dialect(), StandardGroup::Distance) == groupUnset)
      return;
    const Truth on = state.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental});
    // What the program has switched on itself is on, whatever unknown codes are around it.
    if (on == Truth::No || (on != Truth::Yes && state.may(Fact::UnknownCode)))
      return;
    const CodeInfo *code = state.activeCode(ctx.dialect(), StandardGroup::Distance);
    const SourceRange where = event.kind == EventKind::FlowIssue ? ctx.flowRange()
                              : event.word                       ? ctx.range(*event.word)
                                                                 : ctx.blockRange();
    if (auto finding = ctx.report(where, on == Truth::Yes))
      finding
          .message("the program ends with `{0}` on: the next one drives its coordinates as "
                   "distances",
                   code ? code->name : "incremental dimensions")
          .note(state.originOf(ctx.dialect(), StandardGroup::Distance), "it is switched on here");
  }

private:
  /// `G91 G54 X30. Y20.`: the first place of a tool in a work offset is no distance.
  static void atZeroPoint(const Event &event, RuleContext &ctx) {
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    const CodeUse *const distances = ctx.find({Action::Incremental});
    if (!distances || ctx.code(*distances).letter != 'G' || ctx.code(event).letter != 'G' ||
        (axesOf(ctx.dialect(), ctx.block()) & plane) != plane || ctx.before().modalCalls ||
        ctx.find({Action::ReferenceReturn, Action::MachineMove, Action::DataInput}))
      return sleepInShape();
    // All increments of 0 select the work offset alone.
    if (llvm::all_of(ctx.block().words, [&](const Word &word) {
          return !(ctx.dialect().axisWords & maskOf(word.address)) ||
                 (word.isNumber() && word.mantissa == 0);
        }))
      return;
    if (auto finding = ctx.report(*distances->word))
      finding.severity(Severity::Warning)
          .message("`{0}` in the block of `{1}`: the first place in a work offset is no distance, "
                   "and what follows counts so too",
                   ctx.text(*distances->word), ctx.text(*event.word));
  }

  /// What a called program sets outlives its return: what it has switched on itself it ends.
  static void atReturn(const Event &event, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Origin on = state.originOf(ctx.dialect(), StandardGroup::Distance);
    if (ctx.callDepth() == 0 || state.may(Fact::UnknownCode) ||
        state.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
            Truth::Yes ||
        !isIn(ctx, on, ctx.index().programAt(ctx.block().begin)))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("the program returns with incremental dimensions on, which it has switched "
                   "on itself: its caller's coordinates become distances")
          .note(on, "it is switched on here");
  }

  bool notAtEnd_ = false; ///< the end takes it back
  bool home_ = false;     ///< the move after a way home is looked at
  double longest_ = 20;   ///< a rapid move away from home of more than this is a coordinate, mm

  /// `G91 G28 Z0` and then a rapid move in the plane whose words look like places of the work.
  bool afterHome(const Event &event, const Origin &on, RuleContext &ctx) const {
    if (!home_ || event.kind != EventKind::Motion || event.motion != MotionKind::Rapid ||
        event.inMachineCoordinates() || !on.known() || ctx.find({Action::Incremental}) ||
        (isHere(ctx, on) && on.begin >= ctx.block().begin && on.begin < ctx.block().next))
      return false;
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    bool looks = false;
    AddressMask outwards = 0; // beyond the reference point, as far as it is an end of the axis
    for (const Word &word : ctx.block().words)
      if ((ctx.dialect().axisWords & maskOf(word.address)) && word.isNumber()) {
        looks |= word.value() * unit.value_or(1) > longest_;
        outwards |= word.value() > 0 ? maskOf(word.address) : 0;
      }
    if (!looks && !outwards)
      return false;
    // The first move after it that is none to the reference point.
    BlocksBefore before(ctx);
    Block block;
    while (before.next(block)) {
      const bool home = findCode(ctx.dialect(), block, {Action::ReferenceReturn});
      if (before.unit().source.id() == on.file && block.begin <= on.begin && on.begin < block.next)
        return home && (looks || (!ctx.dialect().isLathe() && block.hasAny(outwards)));
      if (home)
        continue;
      looks &= !block.hasAny(ctx.dialect().axisWords);
      for (const Word &word : block.words)
        outwards &= ~maskOf(word.address);
      if (!looks && !outwards)
        return false;
    }
    return false;
  }

  /// The row of holes before was made by distances, which its second block switched on. After the
  /// end of the cycle the tool goes to a place, at which nothing is made by distances.
  bool afterRow(const Event &event, const Origin &on, RuleContext &ctx) const {
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    constexpr unsigned furthest = 12; // blocks
    const Dialect &dialect = ctx.dialect();
    if (event.kind != EventKind::Motion || event.motion != MotionKind::Rapid || dialect.isLathe() ||
        event.axes != plane || event.inMachineCoordinates() || ctx.before().modalCalls ||
        !isHere(ctx, on) || on.begin >= ctx.block().begin)
      return false;
    const double unit = millimetresPer(dialect, ctx.before()).value_or(1);
    if (!llvm::all_of(ctx.block().words, [&](const Word &word) {
          return !(dialect.axisWords & maskOf(word.address)) ||
                 (word.isNumber() && word.value() * unit > longest_);
        }))
      return false;
    BlocksBefore before(ctx);
    Block block;
    bool ended = false;
    for (unsigned i = 0; i < furthest && before.next(block); ++i) {
      const bool moves = (axesOf(dialect, block) & plane) != 0;
      if (block.begin <= on.begin && on.begin < block.next)
        return ended && moves && !findCode(dialect, block, {Action::Cycle}) &&
               !hasMotionCode(dialect, block) && nothingByDistances(ctx);
      if (findCode(dialect, block, {Action::Cycle, Action::ReferenceReturn}) || (!ended && moves))
        return false;
      ended |= findCode(dialect, block, {Action::CycleCancel}) != nullptr;
    }
    return false;
  }

  /// Before the tool goes on to a place by absolute dimensions, or the program ends, nothing is
  /// drilled or cut here.
  static bool nothingByDistances(RuleContext &ctx) {
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    constexpr unsigned furthest = 12; // blocks
    const Dialect &dialect = ctx.dialect();
    BlocksAhead ahead(ctx);
    Block block;
    bool absolute = false;
    for (unsigned i = 0; i < furthest && ahead.next(block); ++i) {
      if (findCode(dialect, block, {Action::ProgramEnd, Action::ProgramEndRewind}))
        return true;
      absolute |= findCode(dialect, block, {Action::Absolute}) != nullptr;
      if (axesOf(dialect, block) & plane)
        return absolute;
      if (findCode(dialect, block, {Action::Cycle, Action::Linear, Action::ArcCw, Action::ArcCcw}))
        return false;
    }
    return false;
  }

  /// `G0 X0 Y0`: a distance of nothing, where the place of the first cut is meant.
  static bool leadsNowhere(const Event &event, const RuleContext &ctx) {
    constexpr uint16_t plane = 1u << unsigned(Axis::X) | 1u << unsigned(Axis::Y);
    return event.kind == EventKind::Motion && event.motion == MotionKind::Rapid &&
           !ctx.dialect().isLathe() && axesOf(ctx.dialect(), ctx.block()) == plane &&
           !ctx.before().modalCalls && llvm::all_of(ctx.block().words, [&](const Word &word) {
             return !(ctx.dialect().axisWords & maskOf(word.address)) ||
                    (word.isNumber() && word.mantissa == 0);
           });
  }

  /// The block before is a move, too.
  static bool comesByDistance(const RuleContext &ctx) {
    BlocksBefore before(ctx);
    Block block;
    return before.next(block) && block.hasAny(ctx.dialect().axisWords);
  }

  /// Whether what is on was so when the tool was called: a called program that has switched it on
  /// was called before, where no program is called between the tool and here.
  static bool wasOnAt(const Origin &tool, const Origin &on, const RuleContext &ctx) {
    if (on.file == tool.file && isIn(ctx, on, ctx.index().programAt(ctx.block().begin)))
      return on.begin <= tool.begin;
    constexpr uint32_t nearest = 2000; // bytes
    const uint32_t here = ctx.block().begin;
    if (tool.file != ctx.source().id() || ctx.callDepth() > 0 || tool.begin > here ||
        here - tool.begin > nearest)
      return false;
    for (const Block &block : blocks(ctx.index(), tool.begin, here))
      if (!block.items.empty() ||
          findCode(ctx.dialect(), block, {Action::CallProgram, Action::CallLocal}))
        return false;
    return true;
  }

  /// A cycle is called, or the first move with another tool made, under what was on before.
  void early(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    const bool cycle = event.kind == EventKind::CycleRun;
    if (before.isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
            Truth::Yes ||
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
            Truth::Yes)
      return sleepInShape();
    if (event.code == noCode || !event.certain || before.may(Fact::UnknownCode) ||
        (!memory().saysAbsolute && (cycle || !leadsNowhere(event, ctx))))
      return;
    const Origin on = before.originOf(ctx.dialect(), StandardGroup::Distance);
    const Origin &tool = before.origin.of(StatePart::Tool);
    if (cycle) {
      // After a modal call the positions may be distances.
      const CodeInfo &called = ctx.code(event);
      if (called.group != noGroup || before.modalCalls ||
          !(makesHole(called.cycle) || (called.alone && !ctx.dialect().isLathe())))
        return;
    } else if (afterHome(event, on, ctx) || afterRow(event, on, ctx)) {
      ;
    } else if (!event.axes || event.inMachineCoordinates() ||
               event.motion == MotionKind::Reference || !before.must(Fact::ToolCalled) ||
               before.may(Fact::MovedSinceTool) || !ctx.block().hasAny(ctx.dialect().axisWords) ||
               !on.known() || !tool.known() || ctx.find({Action::Incremental}) ||
               !wasOnAt(tool, on, ctx)) {
      return;
    }
    const CodeInfo *code = before.activeCode(ctx.dialect(), StandardGroup::Distance);
    const std::string name = code ? "`" + code->name + "`" : "incremental dimensions";
    // A chain of distances and cycles is meant: a cycle counts its own way.
    const bool chain = cycle && comesByDistance(ctx);
    if (auto finding = ctx.report(event))
      finding.severity(chain ? Severity::Style : Severity::Warning)
          .message(cycle ? "`{0}` is called with {1} still on"
                   : afterHome(event, on, ctx)
                       ? "a move that looks like a coordinate after the way home: {1} is still on"
                   : afterRow(event, on, ctx)
                       ? "a move that looks like a coordinate after a row of holes by distances: "
                         "{1} is still on"
                       : "the first move with this tool is a distance: {1} is still on",
                   ctx.code(event).name, name)
          .note(on, "it is switched on here");
  }
};

} // namespace
NCVET_RULE(CoordinateIncrementalLeftOn, coordinate_incremental_left_on)
} // namespace ncvet
