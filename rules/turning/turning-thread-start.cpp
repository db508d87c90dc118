// A thread starts too near in diameter or in run-in length.
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/thread_passes.h"
#include "analyzer/facts/turned_shape.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/number_text.h"

#include <cmath>

namespace ncvet {
namespace {

class TurningThreadStart final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange({EventKind::CycleRun, EventKind::Motion});
    clearance_ = to.number("clearance", 0);
    depthUnit_ = to.dialect().facts->turning.threadDepthUnit;
    runIn_ = to.number("runInPitches", 2);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    const bool cycle = event.kind == EventKind::CycleRun;
    const bool byInfeed = cycle && code.cycle == CycleKind::ThreadInfeed;
    if (cycle ? !cutsThread(code.cycle) && !byInfeed : event.motion != MotionKind::Thread)
      return sleepInShape();
    const Word *word = ctx.codeWord(event);
    if (!word)
      return;
    if (cycle && code.cycle == CycleKind::ThreadMulti)
      diameter(event, code, *word, ctx);
    else if (cycle && !byInfeed)
      passes(event, code, *word, ctx);
    runIn(event, code, *word, ctx);
    if (cycle)
      runsAway(event, code, *word, ctx);
    if (cycle && code.cycle == CycleKind::ThreadMulti)
      insideWork(event, code, *word, ctx);
  }

private:
  void diameter(const Event &event, const CodeInfo &code, const Word &word,
                RuleContext &ctx) const {
    const Interval &start = ctx.before().at(Axis::X);
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    const Word *heightWord = wordOf(ctx.block(), code, Role::Height);
    const auto height = valueOf(ctx, code, Role::Height);
    if (!unit || !start.isConstant() || ctx.before().inMachineCoordinates(Axis::X) || !heightWord ||
        !height || *height <= 0)
      return;
    const auto end = endOf(ctx, Axis::X, start);
    // A taper moves the crest between the ends of the thread.
    if (!end || (wordOf(ctx.block(), code, Role::Taper) && valueOf(ctx, code, Role::Taper) != 0.0))
      return;
    // A least increment is 0.001 mm, or 0.0001 inch.
    const double increment = depthUnit_ < 1 && *unit > 1 ? depthUnit_ / 10 : depthUnit_;
    const double scale = heightWord->has(wordPoint) ? 1 : increment;
    const double depth = *height * *unit * scale;
    if (depth > 20) // no thread: the unit was meant otherwise
      return;
    const bool outside = start.value() > *end;
    const double crest = outside ? *end + 2 * depth : *end - 2 * depth;
    const double clear = outside ? start.value() - crest : crest - start.value();
    constexpr double tolerance = 1e-6;
    if (clear >= clearance_ - tolerance && (clearance_ > 0 || clear > tolerance))
      return;
    if (auto finding = ctx.report(word, event.certain))
      finding.message(
          "`{0}` starts at X{1}, and the crest of the thread lies at X{2}: the tool returns "
          "{3} the crest",
          code.name, shortNumber(start.value() / *unit), shortNumber(crest / *unit),
          clear < 0 ? "through" : "too near to");
  }

  /// Passes that fall cut an outside thread, and those that grow one in a bore. A start that lies
  /// among them is not clear of the crest.
  static void passes(const Event &event, const CodeInfo &code, const Word &word, RuleContext &ctx) {
    const Interval &start = ctx.before().at(Axis::X);
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    if (ctx.before().activeCode(ctx.dialect(), StandardGroup::Motion) == &code ||
        ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle) == &code || !unit ||
        !start.isConstant() || ctx.before().inMachineCoordinates(Axis::X) ||
        (wordOf(ctx.block(), code, Role::Taper) && valueOf(ctx, code, Role::Taper) != 0.0))
      return;
    const auto end = endOf(ctx, Axis::X, start);
    const double from = start.value() / *unit;
    const llvm::SmallVector<double, 8> later = threadPassesAhead(ctx, from);
    if (!end || later.empty())
      return;
    const double first = *end / *unit, last = later.back();
    if (first == last || (last < first) != (later.front() <= first) ||
        (last < first ? from > first : from < first))
      return;
    // A list that is beyond its start and comes closer to it: it is the start that is wrong.
    if ((last < first ? from < last : from > last) && later.size() < 2)
      return; // of two passes it may be the second
    if (auto finding = ctx.report(word, event.certain))
      finding.message("`{0}` starts at X{1}, and its passes go from X{2} to X{3}: the tool returns "
                      "through the crest",
                      code.name, shortNumber(from), shortNumber(first), shortNumber(last));
  }

  /// Before the face and on from there, away from the work: the sign of the end is missing.
  static void runsAway(const Event &event, const CodeInfo &code, const Word &word,
                       RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const Interval &start = before.at(Axis::Z);
    if (!event.certain || !start.isConstant() || start.value() <= 0 ||
        before.inMachineCoordinates(Axis::Z) || !before.frames.empty() || ctx.callDepth() > 0 ||
        before.may(Fact::UnknownCode))
      return;
    const auto end = endOf(ctx, Axis::Z, start);
    if (!end || *end <= start.value() || !liesBelowZero(ctx))
      return;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning)
          .message("`{0}` cuts from Z{1} to Z{2}, away from the work, which lies below zero",
                   code.name, shortNumber(start.value() / unitOf(ctx)),
                   shortNumber(*end / unitOf(ctx)));
  }

  /// The tool goes down to its passes where the program leaves more than the thread's root: the
  /// start lies past the face. Threads that begin in a groove are cut from there.
  void insideWork(const Event &event, const CodeInfo &code, const Word &word,
                  RuleContext &ctx) const {
    constexpr double deep = 0.3, groove = 5, beyond = 1; // mm
    const auto move = turnedMove(ctx);
    const auto end = endOf(ctx, Axis::X, ctx.before().at(Axis::X));
    const auto endZ = endOf(ctx, Axis::Z, ctx.before().at(Axis::Z));
    if (!event.certain || !move || !end || !endZ || *endZ >= move->fromZ * move->unit)
      return;
    const double root = *end / move->unit;
    const TurnedShape &shape = shapes_.of(ctx);
    const uint32_t here = ctx.block().begin;
    const auto left = shape.diameter({here, move->fromZ});
    const auto before = shape.diameter({here, move->fromZ + beyond / move->unit});
    if (!left || !before || *left < root + deep / move->unit || *before != *left ||
        move->fromX < *left || shape.isOpened({here, move->fromZ}, root, groove / move->unit))
      return;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning)
          .message("`{0}` starts at Z{1}, where the program leaves a diameter of {2}: the passes "
                   "begin in the middle of it",
                   code.name, shortNumber(move->fromZ), shortNumber(*left));
  }
  TurnedShapes shapes_;

  static double unitOf(const RuleContext &ctx) {
    return millimetresPer(ctx.dialect(), ctx.before()).value_or(1);
  }

  /// The program has cuts below zero, and one work offset.
  static bool liesBelowZero(const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const CodeInfo *offset = nullptr;
    bool below = false;
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
      const CodeInfo *const other = findCode(dialect, block, {Action::WorkOffset});
      if (other && offset && other != offset)
        return false;
      offset = other ? other : offset;
      if (findCode(dialect, block, {Action::PresetPosition, Action::FrameSet, Action::FrameAdd}))
        return false;
      const Word *const z = block.find(letterAddress('Z'));
      below |=
          z && z->isNumber() && z->value() < 0 && !findCode(dialect, block, {Action::MachineMove});
    }
    return below;
  }

  void runIn(const Event &event, const CodeInfo &code, const Word &word, RuleContext &ctx) const {
    const auto face = ctx.machine().number("partFaceZ");
    const Interval &start = ctx.before().at(Axis::Z);
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    const Word *lead = wordOf(ctx.block(), code, Role::Lead);
    if (!face || !unit || !lead || !start.isConstant() ||
        ctx.before().inMachineCoordinates(Axis::Z))
      return;
    const Interval pitch = ctx.value(*lead);
    const auto end = endOf(ctx, Axis::Z, start);
    if (!pitch.isConstant() || !end || *end >= *face)
      return;
    const double distance = start.value() - *face;
    if (distance < -1e-6 || distance >= runIn_ * pitch.value() * *unit - 1e-6)
      return;
    if (auto finding = ctx.report(word, event.certain))
      finding
          .message("`{0}` starts {1} before the face: the slide needs about {2} pitches ({3}) to "
                   "reach its "
                   "speed",
                   code.name, shortNumber(distance / *unit), shortNumber(runIn_),
                   shortNumber(runIn_ * pitch.value()))
          .severity(Severity::Warning);
  }

  double clearance_ = 0, depthUnit_ = 1, runIn_ = 2;
};

} // namespace
NCVET_RULE(TurningThreadStart, turning_thread_start)
} // namespace ncvet
