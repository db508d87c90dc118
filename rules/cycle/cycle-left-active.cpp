// A modal cycle is still active where the operation is over: tool change, program end, return.
#include "analyzer/facts/after_calls.h"
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/measuring_series.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/state/any_state.h"

#include <map>

namespace ncvet {
namespace {

struct CycleLeftActiveMemory {
  /// A cycle that is still active somewhere.
  struct Left {
    SourceRange place;
    Origin origin;
    std::string name, message, cancel;
    TextEdit edit;
    bool certain = false;
    bool judged = false; ///< a caller was seen

    void report(RuleContext &ctx) const {
      if (auto finding = ctx.report(place, certain))
        finding.text(message)
            .note(origin, name + " becomes active here")
            .fix(FixSafety::Unsafe, "insert " + cancel + " before this block", edit);
    }
  };
  Origin said;       ///< a cycle that was left active at the end of measuring
  OncePerCause once; ///< by where the cycle becomes active, at G28 and tool changes
  std::map<std::pair<FileId, uint32_t>, Left> returned; ///< by where the cycle becomes active
};

class CycleLeftActive final : public StatefulRule<CycleLeftActiveMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::ToolChange, EventKind::ProgramEnd, EventKind::Return, EventKind::CycleRun,
           EventKind::CallReturned});
    if (to.dialect().emptyBlocksRun)
      to.on(EventKind::ToolWord);
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::Cycle && code.group == noGroup && !code.arguments &&
             code.cycle < CycleKind::Pattern;
    });
    to.onCode([&](const CodeInfo &code) { return endsSeries(code, to.dialect()); });
    onlyWhereRun_ = to.flag("onlyWhereRun");
    machineMoveTold_ = to.flag("machineMoveTold");
    endEnds_ = to.flag("endEnds");
    if (to.flag("referenceStops"))
      to.onAction({Action::ReferenceReturn, Action::ReferenceFrom, Action::ReferenceCheck});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    const Dialect &dialect = ctx.dialect();
    if (before.profile != ProfileMode::Off)
      return;
    if (endEnds_ && event.kind == EventKind::ProgramEnd)
      return;
    if (event.kind == EventKind::CallReturned) {
      afterCall(ctx);
      backInCaller(ctx);
      return;
    }
    const Truth active = before.cycleActive(dialect);
    if (before.may(Fact::UnknownCode) ||
        (active == Truth::Unknown && anyCycleMayBeOn(before, dialect)))
      return;
    if (active == Truth::No) {
      if (event.kind == EventKind::ProgramEnd)
        calledAtEnd(event, ctx);
      return;
    }
    const CodeInfo *cycle = activeCycle(before, dialect);
    if (event.kind == EventKind::CycleRun) {
      if (event.code != noCode && !ctx.code(event).firesOnEveryBlock &&
          ctx.code(event).cycle != CycleKind::Measure)
        return sleepInShape();
      repeatedPass(event, ctx);
      measuresAway(event, ctx);
      return;
    }
    if (!cycle || endsHere(event, *cycle, ctx))
      return;
    // Whatever moves the axes next does so by a motion code.
    if (onlyWhereRun_ && isPass(*cycle) &&
        (event.kind == EventKind::Code || event.kind == EventKind::ProgramEnd))
      return;
    if (machineMoveTold_ && event.kind == EventKind::ToolChange &&
        before.must(Fact::AtMachinePosition))
      return; // the same was said there
    // Home and to the next tool: one end is missing, and told once.
    const bool reference = event.kind == EventKind::Code && isReference(ctx.code(event));
    const bool change = event.kind == EventKind::ToolChange;
    if ((reference || change) && !memory().once.speaks(before.origin.of(StatePart::Cycle), ctx) &&
        change)
      return;
    // The control has stopped at a reference return: what is still on at the end has the same
    // cause.
    if (event.kind == EventKind::ProgramEnd &&
        !memory().once.maySpeak(before.origin.of(StatePart::Cycle), ctx))
      return;
    if (reference)
      underCycle(event, *cycle, active == Truth::Yes, ctx);
    else
      leftActive(event, *cycle, active == Truth::Yes, ctx);
  }

  /// Programs that no block called, of those that return with the cycle on.
  void finish(const FileSummary &, RuleContext &ctx) const override {
    for (const auto &[place, left] : memory().returned)
      if (!left.judged && left.certain)
        left.report(ctx);
  }

private:
  static bool isReference(const CodeInfo &code) {
    return code.action == Action::ReferenceReturn || code.action == Action::ReferenceFrom ||
           code.action == Action::ReferenceCheck;
  }

  /// A reference return that the control refuses while the cycle is on.
  static void underCycle(const Event &event, const CodeInfo &cycle, bool certain,
                         RuleContext &ctx) {
    if (auto finding = ctx.report(event, certain && event.certain))
      finding
          .message("`{0}` while `{1}` is active: the control stops with an alarm",
                   ctx.text(*event.word), cycle.name)
          .severity(Severity::Error)
          .note(ctx.before().origin.of(StatePart::Cycle), cycle.name + " becomes active here")
          .fix(FixSafety::Unsafe, "insert " + cancelOf(ctx.dialect(), cycle) + " before this block",
               ctx.insertBlockBefore(cancelOf(ctx.dialect(), cycle)));
  }

  /// Whether the block itself ends the cycle, or another of its events says it.
  static bool endsHere(const Event &event, const CodeInfo &cycle, const RuleContext &ctx) {
    // Where every block runs the cycle a T has no place in a list; the change says it for both.
    if (event.kind == EventKind::ToolWord && ctx.find({Action::ToolChange}))
      return true;
    return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      const CodeInfo &code = ctx.code(use);
      const bool ofFamily = code.family.empty() || code.family == cycle.family;
      return (code.cancelsCycle && ofFamily) || code.action == Action::CycleCancel ||
             (isMotion(code.action) && !ctx.dialect().emptyBlocksRun);
    });
  }

  /// The place, in words, at which the cycle must no longer be active; empty: it may be.
  llvm::StringRef placeOf(const Event &event, const CodeInfo &cycle, const Origin &origin,
                          const RuleContext &ctx) const {
    switch (event.kind) {
    case EventKind::ToolWord:
      return "where the next tool is called";
    case EventKind::ToolChange:
      return "at this tool change";
    case EventKind::ProgramEnd:
      return "at the program's end";
    case EventKind::Return:
      return isOfCaller(cycle, origin, ctx) ? "" : "at the return from this program";
    default:
      if (!endsSeries(ctx.code(event), ctx.dialect()))
        return "where a cycle of turning begins";
      return cycle.cycle == CycleKind::Measure ? "at the end of measuring" : "";
    }
  }

  /// A cycle that the caller switched on, or that all callers end, is theirs to switch off.
  bool isOfCaller(const CodeInfo &cycle, const Origin &origin, const RuleContext &ctx) const {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    if (!isIn(ctx, origin, program) || callersEnd(cycle, ctx))
      return true;
    // A part of the same program that it calls by a block's number.
    if (const CallSite *caller = ctx.caller(); caller && caller->program == &program &&
                                               origin.begin < caller->next &&
                                               caller->next <= ctx.block().begin)
      return true;
    // The caller's next motion code ends it: what follows the call decides.
    return endsByMotion(cycle, ctx.dialect()) && ctx.callDepth() > 0;
  }

  void leftActive(const Event &event, const CodeInfo &cycle, bool certain, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    const Dialect &dialect = ctx.dialect();
    const Origin &origin = before.origin.of(StatePart::Cycle);
    if (memory().said == origin && memory().said.known())
      return;
    const llvm::StringRef where = placeOf(event, cycle, origin, ctx);
    // One that was given no place has cut nothing, and its next move is what the program means.
    const bool placed = llvm::any_of(llvm::StringRef("XZUW"),
                                     [&](char letter) { return before.cycle.has(letter); });
    const bool runs = !onlyWhereRun_ && placed;
    if (where.empty() ||
        (!runs && event.kind == EventKind::ToolChange && isPass(cycle) && nextMoveHasCode(ctx)))
      return;
    if (event.kind == EventKind::Code && endsSeries(ctx.code(event), dialect))
      memory().said = origin;
    if (event.kind == EventKind::ToolChange && !ctx.asked() && endsNext(ctx))
      return notCancelled(event, cycle, certain, ctx);
    Memory::Left left;
    left.place = event.word ? ctx.range(*event.word) : ctx.blockRange();
    left.certain = certain;
    left.origin = origin;
    left.name = cycle.name;
    left.message = formatted("`{0}` of line {1} is still active {2}: {4} {3} again", cycle.name,
                             lineOf(ctx, origin), where, verbOf(cycle.cycle),
                             dialect.emptyBlocksRun ? "the block" : "the next position");
    left.cancel = cancelOf(dialect, cycle);
    left.edit = ctx.insertBlockBefore(left.cancel);
    // Switched on only and not run, it may be meant for the places that the caller gives.
    if (event.kind == EventKind::Return && ctx.callDepth() > 0 && !before.may(Fact::CycleRan))
      memory().returned[{origin.file, origin.begin}] = std::move(left);
    else
      left.report(ctx);
  }

  /// Cycles of the motion codes' group, which any of these ends.
  static bool endsByMotion(const CodeInfo &cycle, const Dialect &dialect) {
    const GroupIndex motion = dialect.group(StandardGroup::Motion);
    return motion != noGroup && cycle.group == motion;
  }

  /// A cycle of one pass in turning, which any motion code ends.
  static bool isPass(const CodeInfo &cycle) {
    return cycle.cycle == CycleKind::TurnPass || cycle.cycle == CycleKind::FacePass ||
           cycle.cycle == CycleKind::ThreadPass;
  }

  /// The next block with coordinates begins a move or a cycle of its own, which ends this one.
  static bool endsNext(RuleContext &ctx) {
    return !ctx.dialect().cycleSurvivesMotion && !ctx.dialect().emptyBlocksRun &&
           nextMoveHasCode(ctx);
  }

  /// The cycle is on at a tool change, and nothing runs it there.
  static void notCancelled(const Event &event, const CodeInfo &cycle, bool certain,
                           RuleContext &ctx) {
    const Origin &origin = ctx.before().origin.of(StatePart::Cycle);
    const std::string cancel = cancelOf(ctx.dialect(), cycle);
    if (auto finding = ctx.report(event, certain))
      finding.severity(Severity::Style)
          .message("`{0}` of line {1} is still active at this tool change: the code of the next "
                   "move ends it, no {2} does",
                   cycle.name, lineOf(ctx, origin), cancel)
          .note(origin, cycle.name + " becomes active here")
          .fix(FixSafety::Unsafe, "insert " + cancel + " before this block",
               ctx.insertBlockBefore(cancel));
  }

  /// The next block with coordinates has a motion code of its own.
  static bool nextMoveHasCode(RuleContext &ctx) {
    constexpr unsigned furthest = 30; // blocks
    const Dialect &dialect = ctx.dialect();
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < furthest && ahead.next(next); ++i) {
      if (llvm::any_of(codesOf(dialect, next), [&](CodeIndex code) {
            return isMotion(dialect.codes[code].action) || isPass(dialect.codes[code]) ||
                   makesHole(dialect.codes[code].cycle) ||
                   dialect.codes[code].action == Action::CycleCancel;
          }))
        return true;
      if (next.hasAny(dialect.axisWords) && !findCode(dialect, next, {Action::ReferenceReturn}))
        return false;
    }
    return false;
  }

  /// After a call that has left such a cycle active the caller goes on, without a motion code, to
  /// a place on the free side of the start: it positions, and cuts no further pass.
  static void afterCall(RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const MachineState &after = ctx.after();
    if (after.cycleActive(dialect) != Truth::Yes || after.may(Fact::UnknownCode) ||
        ctx.before().cycleActive(dialect) != Truth::No)
      return;
    const CodeInfo *cycle = activeCycle(after, dialect);
    const Origin &origin = after.origin.of(StatePart::Cycle);
    if (!cycle || !endsByMotion(*cycle, dialect) || !origin.known())
      return;
    BlocksAhead ahead = BlocksAhead::afterCall(ctx);
    Block next;
    bool more = ahead.next(next);
    constexpr unsigned lookAhead = 20;
    for (unsigned i = 0;
         more && next.items.empty() && !next.hasAny(dialect.axisWords | lettersMask("GT")) &&
         !findCode(dialect, next, {Action::ProgramEnd, Action::ProgramEndRewind});
         ++i)
      more = i < lookAhead && ahead.next(next);
    if (!more || !next.items.empty() || next.hasAny(lettersMask("GT")) ||
        !(onFreeSide(next, 'X', Axis::X, ctx) || onFreeSide(next, 'Z', Axis::Z, ctx)))
      return;
    if (auto finding = ctx.report(ahead.range(next)))
      finding
          .message("`{0}` of line {1} is still active after the call: this position {2} again",
                   cycle->name, lineOf(ctx, origin), verbOf(cycle->cycle))
          .note(origin, cycle->name + " becomes active here");
  }

  static bool onFreeSide(const Block &block, char letter, Axis axis, const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Word *word = block.find(letter);
    const Interval &start = state.cycleStart[unsigned(axis)];
    const auto unit = millimetresPer(ctx.dialect(), state);
    if (!word || !word->isNumber() || !start.isConstant() || !unit || !state.cycle.has(letter) ||
        state.inMachineCoordinates(axis))
      return false;
    constexpr double least = 0.5; // mm
    const double pass = state.cycle.get(letter) * *unit - start.value();
    const double place = word->value() * *unit - start.value();
    return (pass < -least && place > least) || (pass > least && place < -least);
  }

  /// A program that switches the cycle on for its caller, which gives the places and ends it, does
  /// what it is there for.
  void backInCaller(RuleContext &ctx) const {
    const Origin &origin = ctx.after().origin.of(StatePart::Cycle);
    const auto left = memory().returned.find({origin.file, origin.begin});
    if (left == memory().returned.end() || ctx.after().cycleActive(ctx.dialect()) == Truth::No)
      return;
    if (ctx.callDepth() > 0 && nothingAfter(ctx)) // handed on to the caller's caller
      return;
    left->second.judged = true;
    if (!endsAfterPlaces(ctx))
      left->second.report(ctx);
  }

  /// Only the return is after the call.
  static bool nothingAfter(RuleContext &ctx) {
    BlocksAhead ahead = BlocksAhead::afterCall(ctx);
    Block next;
    return !ahead.next(next) || findCode(ctx.dialect(), next, {Action::Return});
  }

  /// Whether only places in the plane are between the call and the end of the cycle.
  static bool endsAfterPlaces(RuleContext &ctx) {
    constexpr unsigned most = 200; // blocks that are read
    const Dialect &dialect = ctx.dialect();
    const uint16_t tool = uint16_t(1u << unsigned(toolAxis(dialect, ctx.after())));
    BlocksAhead ahead = BlocksAhead::afterCall(ctx);
    Block next;
    bool more = ahead.next(next);
    for (unsigned i = 0; more && i < most; ++i, more = ahead.next(next)) {
      if (next.skip >= 0 || next.hasLabel())
        return false;
      bool places = next.items.empty();
      for (const CodeIndex index : codesOf(dialect, next)) {
        const CodeInfo &code = dialect.codes[index];
        if (code.action == Action::CycleCancel || code.cancelsCycle)
          return true;
        if (code.cycle == CycleKind::Pattern)
          places = true;
        else if (code.action != Action::Rapid && code.action != Action::Absolute &&
                 code.action != Action::Incremental)
          return false;
      }
      if (!places || (axesOf(dialect, next) & tool))
        return false;
    }
    return false;
  }

  static const CodeInfo *activeCycle(const MachineState &state, const Dialect &dialect) {
    const CodeInfo *found = nullptr;
    for (const StandardGroup which : {StandardGroup::Cycle, StandardGroup::Motion}) {
      const auto codes = state.candidates(dialect, which);
      const auto cycle =
          llvm::find_if(codes, [](const CodeInfo *code) { return code->action == Action::Cycle; });
      if (cycle == codes.end())
        continue;
      if (codes.size() == 1) // the one that is certainly on
        return *cycle;
      found = found ? found : *cycle;
    }
    return found;
  }

  /// A rapid move away, along the tool too, is a place of a measuring cycle that has measured. The
  /// places of one without a depth of its own have that axis.
  static void measuresAway(const Event &event, RuleContext &ctx) {
    const auto tool = uint16_t(1u << unsigned(toolAxis(ctx.dialect(), ctx.after())));
    if (event.code == noCode || !(event.axes & tool) || !ctx.find({Action::Rapid}) ||
        ctx.find({Action::Cycle, Action::CycleCancel}) || !ctx.before().must(Fact::CycleRan))
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.cycle != CycleKind::Measure ||
        llvm::none_of(code.words, [](const WordSpec &w) { return w.role == Role::Depth; }))
      return;
    const Origin &origin = ctx.before().origin.of(StatePart::Cycle);
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding
          .message("`{0}` of line {1} is still active: this move away measures again", code.name,
                   lineOf(ctx, origin))
          .note(origin, code.name + " becomes active here");
  }

  /// A cycle that is called in the very block that ends the program, and that nothing cancels.
  static void calledAtEnd(const Event &event, RuleContext &ctx) {
    for (const CodeUse &use : ctx.codes()) {
      const CodeInfo &cycle = ctx.code(use);
      if (cycle.action != Action::Cycle || cycle.group == noGroup || !ctx.dialect().emptyBlocksRun)
        continue;
      if (auto finding = ctx.report(event, event.certain))
        finding
            .message("`{0}` ends the program in the block that calls `{1}`: no `{2}` cancels it",
                     ctx.text(*event.word), cycle.name, cancelOf(ctx.dialect(), cycle))
            .note(ctx.range(*use.word), cycle.name + " becomes active here");
      return;
    }
  }

  /// Whether the first thing that every caller does is to end the cycle. Where what a program sets
  /// is to outlive its return, the program has to end what it has begun.
  bool callersEnd(const CodeInfo &cycle, const RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    if (dialect.facts->program.modesOutliveReturn)
      return false;
    const auto judge = [&](const Block &block) {
      for (const CodeIndex index : codesOf(dialect, block)) {
        const CodeInfo &code = dialect.codes[index];
        if (code.action == Action::CycleCancel ||
            (code.action == Action::Cycle && code.group != noGroup && code.group == cycle.group) ||
            (code.cancelsCycle && (code.family.empty() || code.family == cycle.family)) ||
            (isMotion(code.action) && !dialect.cycleSurvivesMotion))
          return AfterCall::Ends;
      }
      // Only codes that leave the tool where it is are before the cycle's end.
      const bool idle = llvm::all_of(block.words, [&](const Word &word) {
        const CodeIndex index = codeOf(dialect, word);
        return index != noCode && waits(dialect.codes[index].action);
      });
      return idle && !dialect.emptyBlocksRun ? AfterCall::GoesOn : AfterCall::Relies;
    };
    return afterCalls_.allEnd(
        cycle.base, ctx, [] {}, judge);
  }
  AfterCalls afterCalls_;
  bool machineMoveTold_ = false; ///< of a machine position under a cycle the table speaks
  bool endEnds_ = false;         ///< the end of the program ends cycles
  bool onlyWhereRun_ = false;    ///< told only where the next position would run it

  /// Codes beside which an active cycle makes nothing.
  static bool waits(Action action) {
    switch (action) {
    case Action::CoolantOn:
    case Action::CoolantOff:
    case Action::SpindleStop:
    case Action::ProgramStop:
    case Action::OptionalStop:
      return true;
    default:
      return false;
    }
  }

  /// A cycle that every block without a motion code runs again, in a block that gives it nothing.
  static void repeatedPass(const Event &event, RuleContext &ctx) {
    if (event.code == noCode || !event.certain)
      return;
    const CodeInfo &code = ctx.code(event);
    // Where blocks without any word run the cycle too, a rule of its own speaks of all of them.
    if (!code.firesOnEveryBlock || ctx.block().words.empty() || ctx.dialect().emptyBlocksRun)
      return;
    AddressMask own = code.takes | ctx.dialect().axisWords;
    for (const WordSpec &spec : code.words)
      own |= spec.any;
    if (ctx.block().hasAny(own))
      return;
    for (const CodeUse &use : ctx.codes())
      if (use.code == event.code)
        return;
    const Origin &origin = ctx.before().origin.of(StatePart::Cycle);
    const std::string cancel = cancelOf(ctx.dialect(), code);
    // A G code that moves nothing may end the cycle: manuals speak of "another G code".
    const bool mayEnd = ctx.block().has(letterAddress('G'));
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.severity(mayEnd ? std::optional(Severity::Warning) : std::nullopt)
          .message("`{0}` of line {1} is still active: this block {2} the last {3} again",
                   code.name, lineOf(ctx, origin),
                   code.cycle == CycleKind::ThreadPass ? "cuts" : verbOf(code.cycle),
                   makesHole(code.cycle) ? "hole" : "pass")
          .note(origin, code.name + " becomes active here")
          .fix(FixSafety::Unsafe, "insert " + cancel + " before this block",
               ctx.insertBlockBefore(cancel));
  }
};

} // namespace
NCVET_RULE(CycleLeftActive, cycle_left_active)
} // namespace ncvet
