// A block runs the active cycle again although it looks like a retract or a plain move.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/geometry/point.h"

#include <cmath>

namespace ncvet {
namespace {

/// Blocks that are read after a position to see whether the operation is over.
constexpr unsigned lookahead = 12;
/// Holes that are read back to know how far the holes of a list lie apart.
constexpr unsigned lookback = 200;

struct CycleUnintendedExecutionMemory {
  OncePerCause once; ///< a call that a called program has left on
};

class CycleUnintendedExecution final : public StatefulRule<CycleUnintendedExecutionMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    machineMoves_ = to.dialect().facts->cycles.firesInMachineMoves;
    if (machineMoves_)
      to.onChange({EventKind::Motion});
    for (const CodeInfo &code : to.dialect().codes)
      waits_ |= code.waits;
    if (waits_)
      to.on(EventKind::ToolChange);
    farFactor_ = to.number("farFactor", 1.5);
    calls_ = to.dialect().facts->cycles.firesInCalls;
    if (calls_)
      to.on(EventKind::Call);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Call)
      return call(ctx);
    if (event.kind == EventKind::Motion)
      return machineMove(event, ctx);
    if (event.kind == EventKind::ToolChange) {
      const CodeInfo *const call = ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle);
      if (ctx.before().cycleActive(ctx.dialect()) == Truth::Yes &&
          !cycleOutlivesTool(ctx.before()) && call && call->waits)
        if (auto finding = ctx.report(event))
          finding
              .message("the tool changes while a modal call is on: the path to the change and back "
                       "runs the cycle")
              .note(ctx.before().origin.of(StatePart::Cycle), "the modal call begins here");
      return;
    }
    // At a change it was told; what the new tool does has the same cause.
    if (event.code == noCode || ctx.block().words.empty() ||
        (cycleOutlivesTool(ctx.before()) && (waits_ || ctx.before().may(Fact::MovedSinceTool))))
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.group == noGroup) // a cycle of one block
      return;
    for (const CodeUse &use : ctx.codes())
      if (ctx.code(use).action == Action::Cycle)
        return;
    if (waits_ && makesHole(code.cycle) && isLeftOn(ctx))
      return report(event, code, ctx, true, "after the program that has called it");
    if (makesHole(code.cycle) && waits_ &&
        !(event.axes & ~(1u << unsigned(toolAxis(ctx.dialect(), ctx.after())))))
      sameBlock(event, code, ctx);
    else if (makesHole(code.cycle))
      checkHole(event, code, ctx);
    else if (code.firesInPlane && code.cycle != CycleKind::Measure)
      checkMilling(event, code, ctx);
    else if (code.cycle == CycleKind::TurnPass || code.cycle == CycleKind::ThreadPass)
      checkPass(event, code, Axis::X, ctx);
    else if (code.cycle == CycleKind::FacePass)
      checkPass(event, code, Axis::Z, ctx);
  }

private:
  /// Whether this is the first position of the main program after a program that was called, has
  /// begun the modal call, and has gone to its own places.
  bool isLeftOn(RuleContext &ctx) const {
    const Origin &begun = ctx.before().origin.of(StatePart::Cycle);
    if (ctx.callDepth() > 0 || !begun.known())
      return false;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const bool here = begun.file == ctx.source().id() && begun.begin >= program.begin &&
                      begun.begin < program.end;
    return !here && memory().once.speaks(begun, ctx) && ctx.before().must(Fact::CycleRan);
  }

  /// A program is called between the holes: where it moves at feed it is no list of places.
  static void call(RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const CodeInfo *cycle = before.activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (!cycle || !makesHole(cycle->cycle) || before.cycleActive(ctx.dialect()) != Truth::Yes ||
        !before.must(Fact::CycleRan) || ctx.outcome().flow.kind != FlowKind::CallNamed ||
        comesBackWithoutMove(ctx))
      return;
    if (auto finding = ctx.report(ctx.flowRange().end ? ctx.flowRange() : ctx.blockRange()))
      finding
          .message("a program is called while `{0}` of line {1} is active: every place that it "
                   "goes to is drilled",
                   cycle->name, lineOf(ctx, before.origin.of(StatePart::Cycle)))
          .note(before.origin.of(StatePart::Cycle), cycle->name + " becomes active here");
  }

  /// Whether the called program, in a file of its own, is known to move nothing.
  static bool comesBackWithoutMove(RuleContext &ctx) {
    BlocksAhead ahead(ctx);
    Block next;
    bool entered = false;
    while (ahead.next(next)) {
      if (&ahead.unit() == &ctx.unit())
        return entered;
      entered = true;
      if (next.hasAny(ctx.dialect().axisWords | ctx.dialect().polarWords))
        return false;
    }
    return false;
  }

  /// A move in machine coordinates runs the cycle as every other place does.
  static void machineMove(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const CodeInfo *cycle = before.activeCode(ctx.dialect(), StandardGroup::Cycle);
    const CodeUse *use = ctx.find({Action::MachineMove});
    if (!event.inMachineCoordinates() || !use || !cycle || !makesHole(cycle->cycle) ||
        before.cycleActive(ctx.dialect()) != Truth::Yes ||
        after.cycleActive(ctx.dialect()) != Truth::Yes || before.may(Fact::UnknownCode))
      return;
    report(event, *cycle, ctx, false, "at a machine position");
  }

  /// A block that moves nothing in the plane runs a modal call all the same.
  static void sameBlock(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    if (ctx.before().must(Fact::CycleRan))
      report(event, code, ctx, true, "at the place where the tool is");
  }

  bool calls_ = false;        ///< calls under a cycle are looked at
  bool machineMoves_ = false; ///< moves in machine coordinates are places of the cycle

  void checkHole(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    const MachineState &before = ctx.before();
    const Axis tool = toolAxis(ctx.dialect(), ctx.after());
    const auto toolBit = uint16_t(1u << unsigned(tool));
    // A depth that lies above the level from which the cycle drills is a retract.
    if ((event.axes & toolBit) && isRetract(code, tool, ctx)) {
      report(event, code, ctx, true, "to a depth above its start level");
      return;
    }
    // The path to a hole may well be written with its rapid code. Where the operation ends after
    // it, or where it leads far off, it reads like a retract.
    if (code.firesInPlane && ctx.find({Action::Rapid})) {
      const bool alongTool = event.axes & toolBit;
      if (before.must(Fact::CycleRan) && (alongTool || endsWithoutCancel(ctx) || isFar(code, ctx)))
        report(event, code, ctx, false, "at a rapid move");
      return;
    }
    // The first position after a tool change cannot belong to the list of the old tool.
    if (before.must(Fact::ToolCalled) && !before.may(Fact::MovedSinceTool) &&
        before.origin.of(StatePart::Tool).file == before.origin.of(StatePart::Cycle).file &&
        before.origin.of(StatePart::Tool).begin > before.origin.of(StatePart::Cycle).begin) {
      report(event, code, ctx, true, "with the new tool");
      return;
    }
    // A lathe's main spindle drills on its axis only: a move in X leaves it.
    if (ctx.dialect().isLathe() && tool == Axis::Z && (event.axes & 1u << unsigned(Axis::X)) &&
        before.position[0].isConstant() && std::fabs(before.position[0].value()) < 1e-6 &&
        before.liveTool == spindleOff &&
        (before.spindle == spindleCw || before.spindle == spindleCcw) &&
        ctx.after().position[0].isConstant() && std::fabs(ctx.after().position[0].value()) > 1e-6 &&
        !before.may(Fact::UnknownCode)) {
      report(event, code, ctx, true, "beside the spindle's axis");
      return;
    }
    if (!event.axes || (event.axes & toolBit))
      return;
    if (!ctx.dialect().isLathe() && ctx.block().comments.empty() && isFollowedByPlace(ctx))
      return sleepInRow();
    const bool said = commentSaysAway(ctx);
    const bool notCancelled = endsWithoutCancel(ctx);
    if (said && notCancelled)
      report(event, code, ctx, true, nullptr);
    else if (said || (notCancelled && isFar(code, ctx)))
      report(event, code, ctx, false, nullptr);
  }

  /// A pocket or the like that every place repeats: a rapid move away along the tool too.
  static void checkMilling(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const auto tool = uint16_t(1u << unsigned(toolAxis(ctx.dialect(), ctx.after())));
    if ((event.axes & tool) && ctx.find({Action::Rapid}) && ctx.before().must(Fact::CycleRan))
      report(event, code, ctx, false, "at a rapid move");
  }

  /// A pass of a turning cycle whose end lies on the free side of its start cuts nothing.
  static void checkPass(const Event &event, const CodeInfo &code, Axis axis, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    if (!(event.axes & 1u << unsigned(axis)))
      return;
    const char letter = axis == Axis::X ? 'X' : 'Z';
    const Interval &start = ctx.after().cycleStart[unsigned(axis)];
    const auto unit = millimetresPer(ctx.dialect(), before);
    const auto end = endOf(ctx, axis, start);
    if (!start.isConstant() || !unit || !end || !before.cycle.has(letter))
      return;
    const double was = before.cycle.get(letter) * *unit - start.value();
    const double is = *end - start.value();
    constexpr double least = 0.5;
    if (std::isnan(was) || std::fabs(was) < least || std::fabs(is) < least || (was > 0) == (is > 0))
      return;
    report(event, code, ctx, false, "on the free side of its start");
  }

  static bool isRetract(const CodeInfo &code, Axis tool, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const Dialect &dialect = ctx.dialect();
    if (code.cycle == CycleKind::BackBore)
      return false;
    const Word *depth = wordOf(ctx.block(), code, Role::Depth);
    if (!depth)
      return false;
    const Interval value = ctx.value(*depth);
    const auto unit = millimetresPer(dialect, state);
    if (!value.isConstant() || !unit)
      return false;
    const bool incrementMode = dialect.group(StandardGroup::Distance) != noGroup &&
                               state.active(dialect, StandardGroup::Distance) != groupUnset;
    const Truth incremental =
        incrementMode ? state.isActive(dialect, StandardGroup::Distance, {Action::Incremental})
                      : Truth::No;
    if (incremental == Truth::Unknown)
      return false;
    if (incremental == Truth::Yes || depth->has(wordIncremental) ||
        dialect.addresses[depth->address].kind == AddressKind::Increment)
      return value.value() > 0 && (!dialect.isLathe() || drillsDown(code, ctx));
    // The level from which the cycle drills, as it was before this block.
    std::optional<double> level;
    if (const auto r = kept(ctx.before(), code, Role::Retract))
      level = *r * *unit;
    else if (ctx.before().initialLevel.isConstant())
      level = ctx.before().initialLevel.value();
    std::optional<double> old;
    if (const auto z = kept(ctx.before(), code, Role::Depth))
      old = *z * *unit;
    if (!level || !old || *old == *level)
      return false;
    (void)tool;
    const double z = value.value() * *unit;
    // As far off the level as it is, or farther, and on the other side than the hole.
    return *old < *level ? z > *level : z < *level;
  }

  /// Whether the cycle has drilled towards minus so far, from a start that lies before its R.
  static bool drillsDown(const CodeInfo &code, const RuleContext &ctx) {
    const CycleWords &words = ctx.before().cycle;
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    const auto level = kept(ctx.before(), code, Role::Retract);
    const Interval &from = ctx.before().initialLevel;
    if (!unit || !level || !words.has('Z') || words.has('W') || !from.isConstant())
      return false;
    return words.get('Z') < *level && from.value() >= *level * *unit;
  }

  /// True when nothing ends the cycle before the tool changes, the spindle stops or the program
  /// ends.
  static bool endsWithoutCancel(RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    if (isFollowedByPlace(ctx) || isFollowedByCycle(ctx)) // the list goes on, or another one begins
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    bool more = ahead.next(next);
    bool signs = false;
    for (unsigned i = 0; more && i < lookahead; ++i, more = ahead.next(next)) {
      if (!next.items.empty())
        return false;
      for (const CodeIndex index : codesOf(dialect, next)) {
        const CodeInfo &code = dialect.codes[index];
        if (isMotion(code.action) || code.action == Action::CycleCancel || code.cancelsCycle ||
            code.action == Action::Cycle)
          return false;
        switch (code.action) {
        case Action::ToolChange:
        case Action::ProgramEnd:
        case Action::ProgramEndRewind:
        case Action::ReferenceReturn:
        case Action::SpindleStop:
        case Action::ProgramStop:
          return true;
        case Action::CoolantOff:
          signs = true;
          break;
        default:
          break;
        }
      }
      if (dialect.toolChangeByT && next.has(letterAddress('T')))
        return true;
      if (next.hasAny(dialect.axisWords) && !signs)
        return false; // the list goes on
    }
    return false;
  }

  /// Whether the next block of the text is known to call or to cancel a cycle, and says nothing
  /// before that but where to return to.
  static bool isFollowedByCycle(const RuleContext &ctx) {
    const Block *const next = ctx.nextAlike();
    if (!next)
      return false;
    for (const CodeIndex index : codesOf(ctx.dialect(), *next))
      switch (ctx.dialect().codes[index].action) {
      case Action::Cycle:
      case Action::CycleCancel:
        ctx.index().noteRead(next->begin, next->next);
        return true;
      case Action::ReturnInitial:
      case Action::ReturnR:
        break;
      default:
        return false;
      }
    return false;
  }

  /// The block's own comment says that the tool is to go away.
  static bool commentSaysAway(const RuleContext &ctx) {
    for (const Comment &comment : ctx.block().comments) {
      const std::string text = ctx.source().text(comment.begin, comment.end).upper();
      for (const char *word : {"TO CLAMP", "CLEAR OF", "RETRACT", "MOVE AWAY", "GO AWAY", "GO HOME",
                               "TO HOME", "HOME POS", "PARK", "TOOL CHANGE", "CHANGE POS",
                               "SAFE POS", "UNLOAD", "MOVE OFF", "OUT OF THE WAY"})
        if (llvm::StringRef(text).contains(word))
          return true;
    }
    return false;
  }

  /// Whether this position lies farther from the one before than any two of the list.
  bool isFar(const CodeInfo &code, RuleContext &ctx) const {
    const Origin &origin = ctx.before().origin.of(StatePart::Cycle);
    // The list is read from its text: one that another file has begun is not all here.
    if (!isHere(ctx, origin) || origin.begin >= ctx.block().begin)
      return false;
    std::vector<Point> points;
    Block block;
    uint32_t at = ctx.source().lines().lineBegin(origin.begin);
    double x = NAN, y = NAN;
    for (unsigned i = 0; i < lookback && at <= ctx.block().begin; ++i, at = block.next) {
      ctx.index().read(at, block);
      bool moved = false;
      for (const Word &word : block.words) {
        if (word.address != letterAddress('X') && word.address != letterAddress('Y'))
          continue;
        if (!word.isNumber() || word.has(wordIncremental))
          return false;
        (word.address == letterAddress('X') ? x : y) = word.value();
        moved = true;
      }
      if (moved)
        points.push_back({x, y});
    }
    if (at <= ctx.block().begin || points.size() < 3)
      return false;
    if (ctx.dialect().group(StandardGroup::Distance) != noGroup &&
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
            Truth::No)
      return false;
    (void)code;
    double longest = 0;
    const auto stepTo = [&](size_t i) { return distance(points[i - 1], points[i]); };
    for (size_t i = 1; i + 1 < points.size(); ++i)
      longest = std::fmax(longest, stepTo(i));
    const double last = stepTo(points.size() - 1);
    return longest > 0 && last > farFactor_ * longest;
  }

  static void report(const Event &event, const CodeInfo &code, RuleContext &ctx, bool certain,
                     const char *how) {
    const Origin &origin = ctx.before().origin.of(StatePart::Cycle);
    const SourceRange range = ctx.blockRange();
    const std::string cancel = cancelOf(ctx.dialect(), code);
    if (auto finding = ctx.report(range, certain && event.certain))
      finding
          .message("`{0}` {1} again{2}{3}: `{4}` of line {5} is still active", ctx.text(range),
                   verbOf(code.cycle), how ? ", " : "", how ? how : "", code.name,
                   lineOf(ctx, origin))
          .note(origin, code.name + " becomes active here")
          .fix(FixSafety::Unsafe, "insert " + cancel + " before this block",
               ctx.insertBlockBefore(cancel));
  }

  double farFactor_ = 1.5;
  bool waits_ = false; ///< modal calls, which only an own word ends
};

} // namespace
NCVET_RULE(CycleUnintendedExecution, cycle_unintended_execution)
} // namespace ncvet
