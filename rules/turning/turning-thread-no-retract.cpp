// A single thread stroke is not followed by a retract at rapid.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/turned_pass.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

constexpr uint16_t xBit = 1u << unsigned(Axis::X), zBit = 1u << unsigned(Axis::Z);

struct TurningThreadNoRetractMemory {
  bool hasThreads = false; ///< a stroke of a thread was cut
};

class TurningThreadNoRetract final : public StatefulRule<TurningThreadNoRetractMemory> {
public:
  void listen(Subscriptions &to) override {
    lathe_ = to.dialect().isLathe();
    if (lathe_ || to.flag("turns"))
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    if (!lathe_ && !isTurned(ctx))
      return sleepInShape();
    const bool threads =
        before.activeAction(ctx.dialect(), StandardGroup::Motion) == Action::Thread;
    // `G00` in a block of its own is between the stroke and the move back.
    const bool back = event.motion == MotionKind::Rapid && (event.axes & (xBit | zBit)) == zBit &&
                      !event.inMachineCoordinates();
    if (event.motion == MotionKind::Thread)
      memory().hasThreads = true;
    else if (!(threads || back))
      return sleepInShape();
    if (!(threads || (back && memory().hasThreads)))
      return;
    Block stroke;
    if (!readStroke(ctx, stroke) || !(threads || isThread(ctx, stroke)))
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
            .fix(FixSafety::Unsafe, "insert G00 before it", ctx.insertBefore(range.begin, "G00 "));
    } else if (back) {
      if (auto finding = ctx.report(ctx.blockRange(), event.certain))
        finding
            .message(
                "the tool goes back in Z at the depth of the thread: it was not retracted in X")
            .note(ctx.range(stroke), "the thread is cut here");
    }
  }

private:
  /// A thread is in force, and none that is tapped.
  static bool isTurned(const RuleContext &ctx) {
    const CodeInfo *motion = ctx.before().activeCode(ctx.dialect(), StandardGroup::Motion);
    return isTurning(ctx) && !(motion && (motion->leavesNoSpeed || motion->returns));
  }

  bool lathe_ = false;

  /// Reads the stroke along Z that was the last move before the block: nothing but switches
  /// between the two, or the call that leads here.
  static bool readStroke(const RuleContext &ctx, Block &stroke) {
    uint32_t entry = ctx.block().begin; // nothing moves from here on to the current block
    bool more = readPrevious(ctx, stroke);
    while (more && movesNothing(ctx.dialect(), stroke)) {
      entry = stroke.begin;
      more = readBack(ctx, stroke);
    }
    if (more && runsAlongZ(ctx.dialect(), stroke))
      return true;
    return ctx.callDepth() > 0 && readStrokeOfCaller(ctx, entry, !more, stroke);
  }

  /// The stroke gives the code of the thread, or follows the block that does.
  static bool isThread(const RuleContext &ctx, const Block &stroke) {
    constexpr unsigned furthest = 20; // blocks
    Block block = stroke;
    for (unsigned i = 0; i < furthest && block.items.empty(); ++i) {
      if (hasMotionCode(ctx.dialect(), block))
        return findCode(ctx.dialect(), block, {Action::Thread});
      if (!readBack(ctx, block))
        return false;
    }
    return false;
  }

  /// The stroke with which the thread began, when the call after it leads to the current blocks.
  static bool readStrokeOfCaller(const RuleContext &ctx, uint32_t entry, bool fromHead,
                                 Block &stroke) {
    const Origin begun = ctx.before().originOf(ctx.dialect(), StandardGroup::Motion);
    if (!begun.known() || begun.file != ctx.source().id())
      return false;
    const FileIndex &index = ctx.index();
    index.read(ctx.source().lines().lineBegin(begun.begin), stroke);
    if (!runsAlongZ(ctx.dialect(), stroke))
      return false;
    Block call = stroke;
    do {
      if (!readOn(index, call))
        return false;
    } while (movesNothing(ctx.dialect(), call));
    const CodeInfo *code = findCode(ctx.dialect(), call, {Action::CallProgram, Action::CallLocal});
    if (!code)
      return false;
    const bool local = code->action == Action::CallLocal;
    const Word *target = wordOf(call, *code, local ? Role::Sequence : Role::Program);
    if (!target || !target->isNumber())
      return false;
    const int64_t number = int64_t(target->value());
    const ProgramInfo &here = index.programAt(ctx.block().begin);
    if (!local)
      return fromHead && index.find(number) == &here;
    const auto first =
        resolveBlock(index, index.programAt(call.begin), Reference::toBlock(number), call.begin);
    return first && *first >= entry && *first <= ctx.block().begin;
  }

  /// A thread on a face runs along X and retracts in Z, and one that moves both axes may be the
  /// run-out.
  static bool runsAlongZ(const Dialect &dialect, const Block &block) {
    return block.items.empty() && (axesOf(dialect, block) & (xBit | zBit)) == zBit;
  }

  /// Switches, speeds and stops only.
  static bool movesNothing(const Dialect &dialect, const Block &block) {
    if (!block.items.empty() || block.hasAny(dialect.axisWords | maskOf('T')))
      return false;
    for (const Word &word : block.words) {
      const bool isCode = word.address == letterAddress('G') || word.address == letterAddress('M');
      const CodeIndex code = codeOf(dialect, word);
      if (isCode && (code == noCode || !movesNothing(dialect.codes[code].action)))
        return false;
    }
    return true;
  }
  static bool movesNothing(Action action) {
    switch (action) {
    case Action::CoolantOn:
    case Action::CoolantOff:
    case Action::SpindleCw:
    case Action::SpindleCcw:
    case Action::SpindleStop:
    case Action::OptionalStop:
    case Action::ProgramStop:
    case Action::Dwell:
    case Action::Switch:
    case Action::Rapid:
      return true;
    default:
      return false;
    }
  }
};

} // namespace
NCVET_RULE(TurningThreadNoRetract, turning_thread_no_retract)
} // namespace ncvet
