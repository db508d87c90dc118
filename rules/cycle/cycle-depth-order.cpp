// The levels of a drilling cycle lie in the wrong order: start, R, depth.
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/wanted_blocks.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "analyzer/rule/text_answers.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/number_text.h"

#include <cmath>

namespace ncvet {
namespace {

struct CycleDepthOrderMemory {
  /// Planes that were found wrong, and where.
  struct Kept {
    double start = 0, depth = 0, height = 0; ///< NaN: not known
    TextPlace block;

    bool isSame(const Kept &other) const {
      return start == other.start && depth == other.depth &&
             (height == other.height || (std::isnan(height) && std::isnan(other.height)));
    }
  };
  std::optional<Kept> said;
};

class CycleDepthOrder final : public StatefulRule<CycleDepthOrderMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::CycleStart, EventKind::CycleRun});
    to.onCode([](const CodeInfo &code) { return storesPlanes(code); });
    to.onNotices(id);
    absolute_ = to.dialect().facts->cycles.planesAbsolute;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (event.kind == EventKind::Code)
      ctx.reportNotices(id, event);
    if (event.kind == EventKind::CycleRun && code.cycle == CycleKind::Pocket)
      return pocketAbove(event, code, ctx);
    if (event.kind == EventKind::Code ? !storesPlanes(code)
                                      : !makesHole(code.cycle) || cycleOutlivesTool(ctx.after()))
      return;
    if (hasPlanes(code))
      planes(event, code, ctx);
    else
      levels(event, code, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"cycle-depth-order"};
  static constexpr double tolerance = 1e-6;

  /// Whether distances are programmed as increments.
  static Truth incremental(const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const MachineState &state = ctx.after();
    if (dialect.group(StandardGroup::Distance) == noGroup ||
        state.active(dialect, StandardGroup::Distance) == groupUnset)
      return Truth::No;
    return state.isActive(dialect, StandardGroup::Distance, {Action::Incremental});
  }

  /// R and the depth of a cycle, as programmed.
  struct Levels {
    const Word &word; ///< that is reported: R, or else the depth
    double r, z;
    double unit; ///< mm

    double level() const { return r * unit; }
    double depth() const { return z * unit; }
  };

  /// Levels that are words of the cycle.
  void levels(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    const Block &block = ctx.block();
    const Word *rWord = wordOf(block, code, Role::Retract);
    const Word *zWord = wordOf(block, code, Role::Depth);
    const char other = depthOfPlane(code, ctx);
    if (other)
      zWord = block.find(other);
    if (!rWord && !zWord) // one more hole of a row
      return sleepInShape();
    const MachineState &state = ctx.after();
    const auto unit = millimetresPer(ctx.dialect(), state);
    const auto r = kept(state, code, Role::Retract);
    auto z = kept(state, code, Role::Depth);
    if (other) {
      z = state.cycle.has(other) ? std::optional(state.cycle.get(other)) : std::nullopt;
      if (z && std::isnan(*z))
        z.reset();
    }
    if (zWord && unit && z && countsFromApproach(*zWord, ctx) && code.cycle != CycleKind::BackBore)
      countsUpwards(event, code, *zWord, *z * *unit, ctx);
    const bool increments = incremental(ctx) != Truth::No;
    if (unit && r && zWord && !increments && upwards(*zWord, *r * *unit, ctx)) {
      if (auto finding = ctx.report(*zWord, event.certain))
        finding.message("`{0}` leads away from the bottom of the hole: `{1}` begins at {2} and "
                        "there is nothing to drill",
                        ctx.text(*zWord), code.name,
                        shortNumber(state.initialLevel.value() / *unit));
      return;
    }
    if (unit && z && zWord && !r && drillsAway(event, *zWord, *z * *unit, ctx)) {
      if (auto finding = ctx.report(*zWord))
        finding.message("`{0}` leads away from the work: `{1}` begins at {2} and there is nothing "
                        "to drill",
                        ctx.text(*zWord), code.name,
                        shortNumber(state.initialLevel.value() / *unit));
      return;
    }
    if (!unit || !r || !z || increments || mixed(state.cycle, code, ctx.dialect()) ||
        (rWord && rWord->has(wordIncremental)) || (zWord && zWord->has(wordIncremental)))
      return;
    const Levels levels{rWord ? *rWord : *zWord, *r, *z, *unit};
    const bool counterbores = addressesOf(code, Role::Counterbore); // from R down first
    if (code.cycle == CycleKind::BackBore && !counterbores)
      boresUpwards(event, code, levels, ctx);
    else if (std::fabs(levels.level() - levels.depth()) <= tolerance)
      nothingBetween(event, code, levels, ctx);
    else if (levels.level() < levels.depth())
      belowDepth(event, code, levels, ctx);
    else if (!belowZero(event, code, levels, ctx) && !aboveWork(event, code, levels, ctx))
      startsBelow(event, code, levels, ctx);
  }

  /// The hole ends above zero, where all others of the program end below it.
  bool aboveWork(const Event &event, const CodeInfo &code, const Levels &levels,
                 RuleContext &ctx) const {
    constexpr double nearZero = 10; // mm: the work begins there
    if (levels.z <= 0 || levels.level() > nearZero || event.kind != EventKind::CycleStart ||
        !event.certain || ctx.dialect().isLathe() || !ctx.after().frames.empty() ||
        ctx.after().may(Fact::UnknownCode) || !isAloneAbove(ctx))
      return false;
    const Word *const depth = wordOf(ctx.block(), code, Role::Depth);
    if (auto finding = ctx.report(depth ? *depth : levels.word))
      finding.severity(Severity::Warning)
          .message("`{0}` ends above zero, and all other cycles of the program below it: was the "
                   "sign of its depth lost?",
                   code.name);
    return true;
  }

  /// The same of a circular pocket, which has no R.
  void pocketAbove(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    constexpr double nearZero = 10; // mm
    const MachineState &state = ctx.after();
    const Word *const depth = wordOf(ctx.block(), code, Role::Depth);
    const auto unit = millimetresPer(ctx.dialect(), state);
    if (!depth || !depth->isNumber() || depth->mantissa <= 0 || depth->has(wordIncremental) ||
        !unit || depth->value() * *unit > nearZero || !event.certain ||
        incremental(ctx) != Truth::No || ctx.dialect().isLathe() || !state.frames.empty() ||
        state.may(Fact::UnknownCode) || !isAloneAbove(ctx))
      return;
    if (auto finding = ctx.report(*depth))
      finding.severity(Severity::Warning)
          .message("`{0}` ends above zero, and all other cycles of the program below it: was the "
                   "sign of its depth lost?",
                   code.name);
  }

  /// By program: whether its cycles have depths below zero, and one alone has a depth above it.
  TextAnswers<std::pair<FileId, uint32_t>, bool> oneAbove_;
  bool isAloneAbove(const RuleContext &ctx) const {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    return oneAbove_.of({ctx.source().id(), program.begin}, [&] {
      constexpr unsigned habit = 2; // cycles
      unsigned below = 0, above = 0;
      for (const Block &block :
           blocksNaming(ctx.index(), program, ctx.dialect(), {Action::Cycle})) {
        const CodeInfo *const cycle = findCode(ctx.dialect(), block, {Action::Cycle});
        const Word *const depth =
            cycle && (makesHole(cycle->cycle) || cycle->cycle == CycleKind::Pocket)
                ? wordOf(block, *cycle, Role::Depth)
                : nullptr;
        if (!depth)
          continue;
        if (findCode(ctx.dialect(), block, {Action::Incremental}) || !depth->isNumber() ||
            depth->has(wordIncremental))
          return false;
        (depth->mantissa < 0 ? below : above) += 1;
      }
      return below >= habit && above == 1;
    });
  }

  /// R lies below zero, where other cycles of the program have the same number above it.
  bool belowZero(const Event &event, const CodeInfo &code, const Levels &levels,
                 RuleContext &ctx) const {
    const Interval &from = ctx.after().initialLevel;
    if (levels.r >= 0 || levels.word.address != letterAddress('R') || !levels.word.isNumber() ||
        !event.certain || event.kind != EventKind::CycleStart || ctx.dialect().isLathe() ||
        !from.isConstant() || from.value() <= 0 || !ctx.after().frames.empty() ||
        !isKnownAbove(levels.r, ctx))
      return false;
    if (auto finding = ctx.report(levels.word))
      finding.severity(Severity::Warning)
          .message("`{0}` lies below zero, and another cycle of the program has R{1}: `{2}` goes "
                   "that far in at rapid before it drills",
                   ctx.text(levels.word), shortNumber(-levels.r), code.name);
    return true;
  }

  /// By program and level: whether another cycle has it above zero.
  TextAnswers<std::pair<std::pair<FileId, uint32_t>, double>, bool> above_;
  bool isKnownAbove(double level, const RuleContext &ctx) const {
    const uint32_t program = ctx.index().programAt(ctx.block().begin).begin;
    return above_.of({{ctx.source().id(), program}, level},
                     [&] { return isAboveElsewhere(level, ctx); });
  }

  static bool isAboveElsewhere(double level, const RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end)) {
      const Word *const r = block.find(letterAddress('R'));
      if (r && r->isNumber() && r->value() == -level &&
          findCode(ctx.dialect(), block, {Action::Cycle}))
        return true;
    }
    return false;
  }

  /// Letter of the depth in another plane, where the cycle's own is a coordinate of the hole; 0: it
  /// is the depth.
  static char depthOfPlane(const CodeInfo &code, const RuleContext &ctx) {
    const Axis tool = toolAxis(ctx.dialect(), ctx.after());
    for (const WordSpec &spec : code.words)
      if (spec.role == Role::Depth)
        for (const Axis axis : {Axis::X, Axis::Y, Axis::Z})
          if (spec.any == maskOf("XYZ"[size_t(axis)]) && axis != tool && tool <= Axis::Z)
            return "XYZ"[size_t(tool)];
    return 0;
  }

  static void boresUpwards(const Event &event, const CodeInfo &code, const Levels &levels,
                           RuleContext &ctx) {
    if (levels.level() < levels.depth() - tolerance)
      return;
    if (auto finding = ctx.report(levels.word, event.certain))
      finding.message("back boring `{0}` cuts upwards: its R ({1}) must lie deeper than Z ({2})",
                      code.name, shortNumber(levels.r), shortNumber(levels.z));
  }

  static void nothingBetween(const Event &event, const CodeInfo &code, const Levels &levels,
                             RuleContext &ctx) {
    if (event.kind != EventKind::CycleStart)
      return; // a later block that goes to R
    if (auto finding = ctx.report(levels.word, event.certain))
      finding.message("{0} and depth of `{1}` are both {2}: there is nothing to drill between "
                      "them",
                      retractOf(code), code.name, shortNumber(levels.z));
  }

  static void belowDepth(const Event &event, const CodeInfo &code, const Levels &levels,
                         RuleContext &ctx) {
    // Drilling towards plus is a matter of lathes with a second spindle; the start tells.
    const Interval &from = ctx.after().initialLevel;
    const bool startKnown = from.isConstant(), lathe = ctx.dialect().isLathe();
    if (startKnown && from.value() <= levels.level() + tolerance && lathe)
      return;
    if (auto finding = ctx.report(levels.word, event.certain && (startKnown || !lathe)))
      finding.message("{0} ({1}) of `{2}` lies below the depth {3}: there is nothing to drill "
                      "between them",
                      retractOf(code), shortNumber(levels.r), code.name, shortNumber(levels.z));
  }

  /// The tool is below R where the cycle begins.
  static void startsBelow(const Event &event, const CodeInfo &code, const Levels &levels,
                          RuleContext &ctx) {
    const Interval &from = ctx.after().initialLevel;
    if (!from.isConstant() || from.value() >= levels.level() - tolerance ||
        event.kind != EventKind::CycleStart)
      return;
    const bool inside = from.value() < levels.depth() - tolerance;
    if (!inside && !ctx.asked()) // up to R it goes through air, and the hole is right
      return;
    if (auto finding = ctx.report(levels.word, event.certain && inside))
      finding
          .message("`{0}` begins at {1}, below its {3} ({2}): the tool rises to {3} at rapid first",
                   code.name, shortNumber(from.value() / levels.unit), shortNumber(levels.r),
                   retractOf(code))
          .severity(inside ? Severity::Warning : Severity::Style);
  }

  /// The depth is an increment, which a mill counts from the level of approach.
  static bool countsFromApproach(const Word &word, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    if (dialect.isLathe() || !(dialect.axisWords & maskOf(word.address)))
      return false;
    return word.has(wordIncremental) || incremental(ctx) == Truth::Yes;
  }

  static void countsUpwards(const Event &event, const CodeInfo &code, const Word &word, double way,
                            RuleContext &ctx) {
    if (way <= 0)
      return;
    if (auto finding = ctx.report(word, event.certain))
      finding.message("`{0}` of `{1}` counts upwards from {2}: there is nothing to drill there",
                      ctx.text(word), code.name, retractOf(code));
  }

  /// A lathe's hole on the axis, drilled from before the face: further away from it.
  static bool drillsAway(const Event &event, const Word &depth, double bottom,
                         const RuleContext &ctx) {
    const Interval &from = ctx.after().initialLevel, &x = ctx.after().at(Axis::X);
    return event.kind == EventKind::CycleStart && event.certain && ctx.dialect().isLathe() &&
           (ctx.dialect().axisWords & maskOf(depth.address)) && !depth.has(wordIncremental) &&
           toolAxis(ctx.dialect(), ctx.after()) == Axis::Z && from.isConstant() &&
           from.value() > 0 && bottom > from.value() + tolerance && x.isConstant() &&
           x.value() == 0 && !ctx.after().inMachineCoordinates(Axis::Z) &&
           !ctx.after().may(Fact::UnknownCode);
  }

  /// An increment of depth away from the work. Whether it counts from R or from the start, a hole
  /// drilled from a start that lies before R goes the other way.
  static bool upwards(const Word &depth, double level, const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const Interval &from = ctx.after().initialLevel, way = ctx.value(depth);
    return dialect.isLathe() && dialect.addresses[depth.address].kind == AddressKind::Increment &&
           dialect.addresses[depth.address].axis == Axis::Z &&
           toolAxis(dialect, ctx.after()) == Axis::Z && from.isConstant() && way.isConstant() &&
           way.value() > 0 && from.value() > level + 1e-6;
  }

  /// The planes of the cycle are variables, which keep their values from block to block.
  static bool hasPlanes(const CodeInfo &code) {
    return llvm::any_of(code.words, [](const WordSpec &word) {
      return word.variable && (word.role == Role::Retract || word.role == Role::Depth);
    });
  }
  /// A call that only stores them for later.
  static bool storesPlanes(const CodeInfo &code) {
    return code.action == Action::Switch && makesHole(code.cycle) && hasPlanes(code);
  }

  /// Planes that are variables, and the words of the block that give them, or null.
  struct Planes {
    const Word *call, *from, *to, *back;
    Memory::Kept now{};
    double up = 1; ///< -1 where the tool comes from below: all planes are the other way round

    bool isBelow(double plane, double other) const { return up * plane < up * other - tolerance; }
  };

  /// Start, depth and return, and the surface when it is known to be zero. Of a later hole only
  /// what its block gives anew.
  void planes(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    const Block &block = ctx.block();
    Planes planes{codeWord(code, ctx), wordOf(block, code, Role::Retract),
                  wordOf(block, code, Role::Depth), wordOf(block, code, Role::Height)};
    const bool given = planes.from || planes.to || planes.back;
    if (!planes.call && !given)
      return;
    const MachineState &state = ctx.after();
    const auto start = kept(state, code, Role::Retract), depth = kept(state, code, Role::Depth);
    if (!start || !depth || (!absolute_ && incremental(ctx) != Truth::No))
      return;
    planes.now = {*start,
                  *depth,
                  kept(state, code, Role::Height).value_or(NAN),
                  {ctx.source().id(), block.begin}};
    // Called again with the planes of which it was said.
    if (!given && memory().said && memory().said->isSame(planes.now) &&
        memory().said->block != planes.now.block)
      return;
    planes.up = comesFromBelow(state) ? -1 : 1;
    if (planes.call || planes.from || planes.to)
      startAndDepth(event, code, planes, ctx);
    if (code.cycle == CycleKind::BackBore)
      return;
    if (planes.call || planes.from || planes.back)
      returnPlane(event, code, planes, ctx);
    if (ctx.machine().option("zeroOnSurface").value_or("") == "true")
      surface(event, code, planes, ctx);
  }

  /// Reports the first of these words that is there, or the call.
  FindingBuilder report(const Event &event, const Planes &planes, const Word *word,
                        const Word *other, RuleContext &ctx) const {
    const Word *found = word ? word : other ? other : planes.call;
    memory().said = planes.now;
    return found ? ctx.report(*found, event.certain) : ctx.report(event, event.certain);
  }

  void startAndDepth(const Event &event, const CodeInfo &code, const Planes &planes,
                     RuleContext &ctx) const {
    const double start = planes.now.start, depth = planes.now.depth;
    if (code.cycle == CycleKind::BackBore) {
      if (!planes.isBelow(start, depth))
        if (auto finding = report(event, planes, planes.to, planes.from, ctx))
          finding.message("back boring `{0}` cuts upwards: its {3} ({1}) must lie deeper than the "
                          "depth {2}",
                          code.name, shortNumber(start), shortNumber(depth), retractOf(code));
    } else if (planes.isBelow(start, depth)) {
      if (auto finding = report(event, planes, planes.to, planes.from, ctx))
        finding.message("{0} ({1}) of `{2}` lies {4} the depth {3}: there is nothing to drill "
                        "between them",
                        retractOf(code), shortNumber(start), code.name, shortNumber(depth),
                        planes.up < 0 ? "above" : "below");
    } else if (!planes.isBelow(depth, start)) {
      if (auto finding = report(event, planes, planes.to, planes.from, ctx))
        finding.message("{0} of `{1}` is its depth {2} too: there is nothing to drill between them",
                        retractOf(code), code.name, shortNumber(depth));
    }
  }

  void returnPlane(const Event &event, const CodeInfo &code, const Planes &planes,
                   RuleContext &ctx) const {
    const double height = planes.now.height, start = planes.now.start;
    if (std::isnan(height) || !planes.isBelow(height, start))
      return;
    if (auto finding = report(event, planes, planes.back, planes.from, ctx))
      finding.message("the return plane {0} of `{1}` lies {3} its start plane {2}",
                      shortNumber(height), code.name, shortNumber(start),
                      planes.up < 0 ? "above" : "below");
  }

  /// The machine's programs have their zero on the surface of the work.
  void surface(const Event &event, const CodeInfo &code, const Planes &planes,
               RuleContext &ctx) const {
    const double start = planes.now.start, depth = planes.now.depth;
    if ((planes.call || planes.from) && start <= 0)
      if (auto finding = report(event, planes, planes.from, nullptr, ctx))
        finding.severity(Severity::Warning)
            .message("the start plane {0} of `{1}` is not above the surface, which is Z0",
                     shortNumber(start), code.name);
    if ((planes.call || planes.to) && depth >= 0)
      if (auto finding = report(event, planes, planes.to, nullptr, ctx))
        finding.severity(Severity::Warning)
            .message("the depth {0} of `{1}` is not below the surface, which is Z0",
                     shortNumber(depth), code.name);
  }

  /// The word that calls the cycle in this block, or null.
  static const Word *codeWord(const CodeInfo &code, RuleContext &ctx) {
    for (const CodeUse &use : ctx.codes())
      if (ctx.code(use).base == code.base)
        return use.word;
    return nullptr;
  }

  bool absolute_ = false; ///< planes are absolute in every mode, and the depth lies below the start

  /// What the control calls the level from which it drills.
  static std::string retractOf(const CodeInfo &code) {
    for (const WordSpec &word : code.words)
      if (word.role == Role::Retract && !word.name.empty())
        return word.name;
    return "R";
  }

  /// The depth was given as an increment (W), alone or beside an absolute one.
  static bool mixed(const CycleWords &words, const CodeInfo &code, const Dialect &dialect) {
    const AddressMask mask = addressesOf(code, Role::Depth);
    for (char letter = 'A'; letter <= 'Z'; ++letter)
      if ((mask & maskOf(letter) & dialect.incrementWords) && words.has(letter))
        return true;
    return false;
  }
};

} // namespace
NCVET_RULE(CycleDepthOrder, cycle_depth_order)
} // namespace ncvet
