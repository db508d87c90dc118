// A cut after rigid tapping, a tool change or an oriented stop, which have stopped the spindle.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"

#include <array>
#include <optional>

namespace ncvet {
namespace {

struct SpindleNotRestartedMemory {
  SourceRange tap{};   ///< block of the last tapped hole
  Origin start;        ///< what had started the spindle there
  bool itself = false; ///< its cycle starts the spindle
  OncePerCause once;
  OncePerCause onceOfChange;
  Origin measured; ///< the call of the tool that was driven against something since
  Aside<std::map<FileId, bool>> starts; ///< by file: it starts a spindle anywhere
};

class SpindleNotRestarted final : public StatefulRule<SpindleNotRestartedMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::Motion, EventKind::CycleRun});
    to.handleNotices();
    to.onCode([](const CodeInfo &code) {
      return llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
    afterTap_ = to.dialect().facts->cycles.tapLeavesDirection;
    wanted_ = to.dialect().facts->spindle.stoppedByCodes;
    habit_ = to.flag("habit");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return ctx.reportNotices(id, event);
    if (event.kind == EventKind::Motion && event.motion == MotionKind::Skip)
      memory().measured = ctx.before().origin.of(StatePart::Tool);
    if (afterTap_)
      directionAfterTap(event, ctx);
    stopped(event, ctx);
    if (habit_)
      againstHabit(event, ctx);
    if (event.code == noCode || !ctx.before().may(Fact::SpindleStoppedByTap) ||
        !ctx.after().may(Fact::SpindleStoppedByTap) ||
        ctx.before().profile == ProfileMode::Recorded) {
      if (!afterTap_ && !wanted_ && !habit_)
        sleepInShape();
      return;
    }
    const CodeInfo &code = ctx.code(event);
    if (event.kind == EventKind::Motion) {
      if (event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
          event.motion == MotionKind::Skip || event.inMachineCoordinates())
        return;
    } else if (code.spindle == SpindleNeed::StartsItself || code.spindle == SpindleNeed::Any ||
               taps(code.cycle)) {
      return;
    }
    const bool certain = event.certain && ctx.before().must(Fact::SpindleStoppedByTap);
    if (!certain && ctx.before().may(Fact::UnknownCode))
      return;
    const Origin &tool = ctx.before().origin.of(StatePart::Tool);
    if ((tool.known() && memory().measured == tool) || !startsSpindle(ctx))
      return;
    const Origin &cause =
        ctx.before().origin.of(stoppedBy(ctx) ? StatePart::Spindle : StatePart::Cycle);
    if (!memory().once.maySpeak(cause, ctx))
      return;
    if (const Started started = startedBetween(ctx);
        started == Started::InChoice || (!certain && started == Started::Yes))
      return;
    if (!memory().once.speaks(cause, ctx))
      return;
    tell(code, certain, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"spindle-not-restarted"};

  static void tell(const CodeInfo &code, bool certain, RuleContext &ctx) {
    if (auto finding = ctx.report(ctx.blockRange(), certain)) {
      if (const CodeInfo *stop = stoppedBy(ctx))
        finding
            .message(
                "`{0}` cuts after `{1}`, which has stopped the spindle: nothing starts it again",
                code.name, stop->name)
            .note(ctx.before().origin.of(StatePart::Spindle), "the spindle is stopped here");
      else
        finding
            .message("`{0}` cuts after rigid tapping: the tapping cycle has stopped the spindle "
                     "and nothing starts it again",
                     code.name)
            .note(ctx.before().origin.of(StatePart::Cycle), "the tapping cycle is called here");
      for (const CodeInfo &start : ctx.dialect().codes)
        if (start.action == Action::SpindleCw) {
          finding.fix(FixSafety::Unsafe, "insert `" + start.name + "` before this block",
                      ctx.insertBlockBefore(start.name));
          break;
        }
    }
  }

  /// The file, or one that has called it, starts a spindle anywhere: others guide what needs none.
  bool startsSpindle(const RuleContext &ctx) const {
    if (isStartedIn(ctx.unit(), ctx.dialect()))
      return true;
    for (const CallSite *caller = ctx.caller(); caller && caller->unit; caller = caller->before)
      if (isStartedIn(*caller->unit, ctx.dialect()))
        return true;
    return false;
  }

  enum class Started : uint8_t { No, Yes, InChoice };

  /// Whether a block between the stop and here starts the spindle on one of the paths: the
  /// conditions of stop, start and cut may be the same. In a choice that begins and ends between
  /// the two it does so on the path which the program means, whatever path is looked at.
  Started startedBetween(const RuleContext &ctx) const {
    const Origin &stop = ctx.before().origin.of(StatePart::Spindle);
    if (!isHere(ctx, stop) || stop.begin >= ctx.block().begin)
      return Started::No;
    ctx.index().reader(); // the text is looked through, now or before
    const auto &[at, how] =
        starts_.of({stop.file, stop.begin}, [&] { return startAfter(stop, ctx); });
    return at < ctx.block().begin ? how : Started::No;
  }

  /// The first block after a stop that starts the spindle.
  static std::pair<uint32_t, Started> startAfter(const Origin &stop, const RuleContext &ctx) {
    constexpr unsigned most = 2000; // blocks
    unsigned depth = 0;
    for (const Block &block :
         blocks(ctx.index().reader(), ctx.source().lines().lineBegin(stop.begin),
                ctx.index().programAt(stop.begin).end, most)) {
      for (const Item &item : block.items)
        if (item.kind == ItemKind::Structure) {
          depth += opensBracket(item.structure);
          depth -= closesBracket(item.structure) && depth;
        }
      if (findCode(ctx.dialect(), block, {Action::SpindleCw, Action::SpindleCcw}))
        return {block.begin, depth ? Started::InChoice : Started::Yes};
    }
    return {~0u, Started::No};
  }

  TextAnswers<std::pair<FileId, uint32_t>, std::pair<uint32_t, Started>> starts_; ///< by the stop

  /// Looked up once for a file.
  bool isStartedIn(const FileUnit &unit, const Dialect &dialect) const {
    const auto [entry, fresh] = memory().starts.look().try_emplace(unit.source.id(), false);
    if (!fresh)
      return entry->second;
    const auto starts = [&](CodeIndex code) {
      const CodeInfo &info = dialect.codes[code];
      return info.action == Action::SpindleCw || info.action == Action::SpindleCcw ||
             info.spindle == SpindleNeed::StartsItself;
    };
    const auto wants = [&](const TextPiece &piece) { return llvm::any_of(piece.codes, starts); };
    for (const ProgramInfo &program : unit.index.programs())
      for (const Block &block : blocksWhere(unit.index, program, wants))
        if (llvm::any_of(codesOf(dialect, block), starts))
          return entry->second = true;
    return false;
  }

  /// The code that stopped the spindle besides doing its own work; null: a tapping cycle did.
  static const CodeInfo *stoppedBy(const RuleContext &ctx) {
    const Origin &origin = ctx.before().origin.of(StatePart::Spindle);
    if (!origin.known())
      return nullptr;
    const CodeIndex code = ctx.dialect().find(ctx.text(origin.range()));
    return code != noCode && ctx.dialect().codes[code].stopsSpindle ? &ctx.dialect().codes[code]
                                                                    : nullptr;
  }

  /// A tapping cycle turns the spindle round, and nothing says which way it turns after it.
  void directionAfterTap(const Event &event, RuleContext &ctx) const {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    const bool tap = code.cycle == CycleKind::Tap || code.cycle == CycleKind::TapLeft;
    if (event.kind == EventKind::CycleRun && tap) {
      memory().tap = ctx.blockRange();
      memory().start = ctx.after().origin.of(StatePart::Spindle);
      memory().itself = code.spindle == SpindleNeed::StartsItself;
      return;
    }
    const bool cuts =
        event.kind == EventKind::CycleRun ? makesHole(code.cycle) : isFeed(event.motion);
    const Origin &start = ctx.after().origin.of(StatePart::Spindle);
    if (memory().itself && (ctx.after().liveTool & (spindleCw | spindleCcw)))
      return; // the driven tool cuts
    if (!cuts || memory().tap.end == 0 || !start.known() || start != memory().start)
      return;
    if (auto finding = ctx.report(ctx.blockRange(), false)) {
      if (memory().itself)
        finding.message("`{0}` cuts after a tapping cycle that starts the spindle itself: whether "
                        "it turns after that is not certain, and nothing starts it again",
                        code.name);
      else
        finding.severity(Severity::Style)
            .message("`{0}` cuts after tapping: which way the spindle turns after its reversal is "
                     "not certain",
                     code.name);
      finding.note(memory().tap, "the tapping cycle runs here");
    }
    memory().tap = {};
  }

  /// The code that stopped it along with its own work is where the start is missing.
  void stopped(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    if (!wanted_)
      return;
    const Origin &cause = state.origin.of(StatePart::Spindle);
    if (event.code == noCode || event.inMachineCoordinates() || !cause.known() ||
        state.spindle != spindleOriented || state.may(Fact::UnknownCode))
      return;
    const CodeInfo &code = ctx.code(event);
    const bool cuts =
        event.kind == EventKind::Motion
            ? event.motion != MotionKind::Rapid && event.motion != MotionKind::Reference &&
                  event.motion != MotionKind::Skip
            : code.spindle == SpindleNeed::Running || code.spindle == SpindleNeed::Clockwise ||
                  code.spindle == SpindleNeed::CounterClockwise;
    if (!cuts || !memory().once.speaks(cause, ctx))
      return;
    const CausePlace place = causePlace(ctx, cause);
    if (auto finding = ctx.report(place.at, event.certain))
      finding
          .message("`{0}` stops the spindle as well, and nothing starts it again before the "
                   "next cut",
                   ctx.text(cause.range()))
          .note(place.other, place.note("the cut", "it stops here"));
  }

  /// The machine's builder decides whether a tool change stops the spindle, and the program knows:
  /// it starts the spindle after all other changes, and after this one it gives a speed alone.
  void againstHabit(const Event &event, RuleContext &ctx) const {
    const MachineState &state = ctx.after();
    const Origin &start = state.origin.of(StatePart::Spindle);
    const Origin &change = state.origin.of(StatePart::Tool);
    const FileId file = ctx.source().id();
    if (event.kind != EventKind::Motion || event.code == noCode || ctx.callDepth() > 0 ||
        event.motion == MotionKind::Rapid || event.motion == MotionKind::Reference ||
        event.motion == MotionKind::Skip || event.inMachineCoordinates() ||
        (state.spindle != spindleCw && state.spindle != spindleCcw) ||
        state.may(Fact::UnknownCode) || !start.known() || !change.known() || start.file != file ||
        change.file != file || start.begin >= change.begin || ctx.block().begin < change.begin ||
        !memory().onceOfChange.speaks(change, ctx))
      return;
    if (startsBeforeOnly(start.begin, change.begin, ctx)) {
      if (auto finding = ctx.report(ctx.blockRange(), event.certain))
        finding
            .message("`{0}` cuts with a spindle that was started before the tool change, which "
                     "stops it on most machines: nothing starts it again",
                     ctx.code(event).name)
            .note(start, "the spindle is started here")
            .note(change, "the tool is changed here");
      return;
    }
    if (!startsAfterOthers(change.begin, ctx))
      return;
    if (auto finding = ctx.report(ctx.blockRange(), false))
      finding
          .message("`{0}` cuts after a tool change that only gives a new speed: after every other "
                   "one the program starts the spindle again",
                   ctx.code(event).name)
          .note(change, "the tool is changed here");
  }

  /// The one start of the spindle in the program is in a block before its first tool change, at
  /// `change`.
  bool startsBeforeOnly(uint32_t start, uint32_t change, const RuleContext &ctx) const {
    const ProgramInfo &program = ctx.index().programAt(change);
    const auto &places = order_.of({ctx.source().id(), program.begin}, [&] {
      std::array<std::optional<uint32_t>, 3> found; // first change, first and second start
      const std::initializer_list<Action> starts = {Action::SpindleCw, Action::SpindleCcw};
      const auto wants = [&](const TextPiece &piece) {
        return piece.mayName(ctx.dialect(),
                             {Action::ToolChange, Action::SpindleCw, Action::SpindleCcw});
      };
      for (const Block &block : blocksWhere(ctx.index(), program, wants)) {
        if (!found[0] && findCode(ctx.dialect(), block, {Action::ToolChange}))
          found[0] = block.begin;
        if (found[1] && !found[2] && findCode(ctx.dialect(), block, starts))
          found[2] = block.begin;
        if (!found[1] && findCode(ctx.dialect(), block, starts))
          found[1] = block.begin;
      }
      return found;
    });
    return places[0] && places[1] && !places[2] && *places[0] <= change &&
           *places[1] < *places[0] && *places[1] <= start && start < *places[0] &&
           ctx.source().lines().lineBegin(change) <= *places[0];
  }

  /// By file and program.
  TextAnswers<std::pair<FileId, uint32_t>, std::array<std::optional<uint32_t>, 3>> order_;

  /// After every tool change of the program, and there are others than that of the block which
  /// holds `change`, the spindle is started; after this one a speed is given.
  static bool startsAfterOthers(uint32_t change, const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(change);
    unsigned others = 0;
    bool open = false, isOwn = false, hasSpeed = false;
    const auto wants = [&](const TextPiece &piece) {
      return piece.hasAny(maskOf(letterAddress('S'))) ||
             piece.mayName(ctx.dialect(),
                           {Action::ToolChange, Action::SpindleCw, Action::SpindleCcw});
    };
    for (const Block &block : blocksWhere(ctx.index(), program, wants)) {
      if (findCode(ctx.dialect(), block, {Action::ToolChange})) {
        if (open && !isOwn)
          return false;
        open = true;
        isOwn = block.begin <= change && change < block.next;
        others += !isOwn;
      }
      if (findCode(ctx.dialect(), block, {Action::SpindleCw, Action::SpindleCcw}))
        open = false;
      if (isOwn && open && block.has(letterAddress('S')))
        hasSpeed = true;
    }
    return others > 0 && hasSpeed && !(open && !isOwn);
  }

  bool habit_ = false;  ///< a tool change that differs from all others is reported
  bool wanted_ = false; ///< other codes than tapping stop it as well
  bool afterTap_ = false;
};

} // namespace
NCVET_RULE(SpindleNotRestarted, spindle_not_restarted)
} // namespace ncvet
