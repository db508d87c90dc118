// A tool change while the tool is in the work or too low.
#include "analyzer/facts/block_before.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/program_tools.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "formats/text/number_text.h"

#include <cmath>

namespace ncvet {
namespace {

struct ToolChangeNearPartMemory {
  /// By the begin of a program: it takes its tools away from the part.
  Aside<std::map<TextPlace, bool>> goesAway;
};

class ToolChangeNearPart final : public StatefulRule<ToolChangeNearPartMemory> {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::ToolChange);
    homeFirst_ = to.flag("homeFirst");
    changesHere_ = to.flag("changesHere");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    if (before.profile != ProfileMode::Off)
      return;
    // What cannot be read may be the way home.
    if (Block previous; readPrevious(ctx, previous) && !previous.issues.empty())
      return;
    if (const auto lowest = ctx.machine().number("toolChangeMinZ")) {
      const Interval &z = before.at(Axis::Z);
      if (z.isConstant() && !before.inMachineCoordinates(Axis::Z) &&
          before.must(Fact::MovedSinceTool) && z.value() < *lowest) {
        if (auto finding = ctx.report(event))
          finding.message("the tool is changed at Z{0}, below the safe Z{1}",
                          shortNumber(z.value()), shortNumber(*lowest));
        return;
      }
    }
    // With M06 a machining centre takes the tool to its own change position.
    const bool atOnce = turns(ctx) || ctx.dialect().toolChangeByT ||
                        (changesHere_ && before.must(Fact::SpindleStated));
    const int32_t is = before.tool, becomes = ctx.after().tool;
    if (is != notSet && is == becomes) // nothing turns
      return;
    if (!atOnce && homeFirst_)
      return withoutHome(event, ctx);
    if (!atOnce || !before.must(Fact::Cut) || ctx.find({Action::ReferenceReturn}))
      return; // (the way home is in the block)
    if (before.may(Fact::AwayFromPart)) {
      afterHole(event, ctx);
      if (!afterTurning(event, ctx) && !afterCut(event, ctx) && !nearCut(event, ctx) && turns(ctx))
        withoutHome(event, ctx);
      return;
    }
    if (isFedClear(ctx) || isStillHome(ctx) || (turns(ctx) && isForGang(ctx)))
      return;
    if (auto finding = ctx.report(event, !before.may(Fact::UnknownCode)))
      finding.message(
          "the tool is changed where the last cut ended: the next one may hit part, chuck "
          "or clamps");
  }

private:
  ProgramTools tools_;
  bool changesHere_ = false; ///< a mill changes its tool wherever it is

  /// The work turns, and the tools are those of a turret or a post.
  static bool turns(const RuleContext &ctx) {
    return ctx.dialect().isLathe() || turnsWork(ctx.dialect(), ctx.before());
  }
  bool homeFirst_ = false; ///< a mill does not go to its change position by itself

  /// A tool that is changed where it has worked, and all others go home first; on a lathe close to
  /// the face.
  void withoutHome(const Event &event, RuleContext &ctx) const {
    constexpr double near = 20;                // mm before the zero point
    const unsigned habit = turns(ctx) ? 2 : 3; // tools
    const MachineState &before = ctx.before();
    const Interval &z = before.at(Axis::Z);
    const ToolPart *const tool = tools_.inUse(ctx);
    if (!tool || tool->home || !tool->follows || !event.certain || ctx.callDepth() > 0 ||
        !before.must(Fact::CutSinceTool) || before.may(Fact::UnknownCode) ||
        before.may(Fact::AtMachinePosition) || before.inMachineCoordinates(Axis::Z) ||
        !z.isConstant() || tool->begin != ctx.block().begin || (turns(ctx) && z.value() > near) ||
        !tools_.allButOne(
            ctx, habit, [](const ToolPart &part) { return part.follows; },
            [](const ToolPart &part) { return part.home; }))
      return;
    if (auto finding = ctx.report(event))
      finding.message("the tool is changed {0} {1} zero, where it has worked: all other changes of "
                      "the program come after a way home",
                      shortLength(ctx, std::fabs(z.value())),
                      z.value() < 0 ? "past"
                      : turns(ctx)  ? "before"
                                    : "above");
  }

  /// On a lathe the last move was one in Z alone, out of the part and clear of its face: G01 was
  /// still in force, and nothing was cut.
  static bool isFedClear(const RuleContext &ctx) {
    constexpr double clear = 20;      // mm before the zero point
    constexpr unsigned furthest = 10; // blocks
    const Interval &z = ctx.before().at(Axis::Z);
    if (!turns(ctx) || !z.isConstant() || z.value() < clear)
      return false;
    Block block;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < furthest; ++i, more = readBack(ctx, block))
      if (block.hasAny(ctx.dialect().axisWords | ctx.dialect().incrementWords))
        return isPlain(block) && block.has(letterAddress('Z')) &&
               !block.hasAny((ctx.dialect().axisWords | ctx.dialect().incrementWords) &
                             ~maskOf('Z'));
    return false;
  }

  /// What has moved since the way home (`G28 U0`, then `W0` in a block of its own) went nowhere.
  static bool isStillHome(const RuleContext &ctx) {
    const AddressMask ways = ctx.dialect().incrementWords;
    BlocksBefore before(ctx);
    Block block;
    while (before.next(block) && isPlain(block)) {
      if (findCode(ctx.dialect(), block, {Action::ReferenceReturn}))
        return true;
      const bool stays =
          !block.hasAny(ctx.dialect().axisWords & ~ways) &&
          llvm::all_of(block.words, [&](const Word &word) {
            return !(maskOf(word.address) & ways) || (word.isNumber() && word.mantissa == 0);
          });
      if (!stays || (!block.hasAny(ways) && !onlySwitches(ctx.dialect(), block)))
        return false;
    }
    return false;
  }

  /// On a lathe a drilling cycle ends at its R, before the face: nothing has moved since then.
  static void afterHole(const Event &event, RuleContext &ctx) {
    if (!turns(ctx) || ctx.before().may(Fact::AtMachinePosition) ||
        ctx.dialect().group(StandardGroup::ReturnLevel) != noGroup)
      return; // (another control may withdraw to where the cycle began)
    BlocksBefore before(ctx);
    Block block;
    while (before.next(block)) {
      if (!block.items.empty() || block.skip >= 0)
        return; // something else may lead here
      const CodeInfo *cycle = findCode(ctx.dialect(), block, {Action::Cycle});
      if (cycle && makesHole(cycle->cycle)) {
        if (auto finding = ctx.report(event, !ctx.before().may(Fact::UnknownCode)))
          finding
              .message("the tool is changed close to the hole, where `{0}` left it: the next "
                       "one may hit part, chuck or clamps",
                       cycle->name)
              .note(wordsRange(before.unit().source.id(), block), "the hole is drilled here");
        return;
      }
      if (!onlySwitches(ctx.dialect(), block))
        return;
    }
  }

  /// The roughing, grooving or threading cycle that the block runs, perhaps as what its code is
  /// under a condition; null: there is none. A finishing cycle is looked at as a cut.
  static const CodeInfo *turningCycle(const Dialect &dialect, const Block &block) {
    return findReading(dialect, block, [](const CodeInfo &code) {
      return roughsProfile(code.cycle) || code.cycle == CycleKind::GrooveRadial ||
             code.cycle == CycleKind::GrooveFace || code.cycle == CycleKind::ThreadMulti;
    });
  }

  /// The block that runs such a cycle, when nothing has moved since then; an empty block: another.
  static Block lastCycle(const RuleContext &ctx) {
    const MachineState &before = ctx.before();
    BlocksBefore way(ctx);
    Block block;
    bool more = way.next(block);
    while (more && isPlain(block) && onlySwitches(ctx.dialect(), block))
      more = way.next(block);
    if (!more || !isPlain(block) || &way.unit() != &ctx.unit())
      return {};
    // The profile of a roughing cycle is not run by itself, on most controls.
    const Origin &roughing = before.origin.of(StatePart::Roughing);
    if (!ctx.dialect().profileRunsThrough && before.roughFirst >= 0 &&
        block.number == before.roughLast && isHere(ctx, roughing))
      readBlockOf(ctx, roughing, block);
    return turningCycle(ctx.dialect(), block) ? block : Block();
  }

  /// Such a cycle ends where it began, which is close to the part.
  static bool afterTurning(const Event &event, RuleContext &ctx) {
    constexpr double nearZ = 20; // mm before the zero point
    const Interval &z = ctx.before().at(Axis::Z);
    const GroupIndex units = ctx.dialect().group(StandardGroup::Units);
    const Block block = turns(ctx) ? lastCycle(ctx) : Block();
    const CodeInfo *const cycle = turningCycle(ctx.dialect(), block);
    if (!cycle || !z.isConstant() || z.value() > nearZ ||
        ctx.before().inMachineCoordinates(Axis::Z) ||
        (units != noGroup && ctx.before().group(units) != groupUnset &&
         !ctx.before().isStated(units)))
      return false;
    if (auto finding = ctx.report(event, !ctx.before().may(Fact::UnknownCode)))
      finding
          .message("the tool is changed where `{0}` began and ended, close to the part: the next "
                   "one may hit part, chuck or clamps",
                   cycle->name)
          // Before the face there may be room for the tools that turn by.
          .severity(z.value() > 0 ? std::optional(Severity::Style) : std::nullopt)
          .note(wordsRange(ctx, block), "the cycle runs here");
    return true;
  }

  /// On a lathe the tool was lifted off the cut in X by a little, and has not moved since then.
  static bool afterCut(const Event &event, RuleContext &ctx) {
    constexpr double little = 10, within = 25; // mm of the diameter; before the face, and past it
    const Dialect &dialect = ctx.dialect();
    const MachineState &before = ctx.before();
    const Interval &x = before.at(Axis::X);
    const auto unit = millimetresPer(dialect, before);
    if (!turns(ctx) || before.may(Fact::AtMachinePosition) || !x.isConstant() ||
        before.inMachineCoordinates(Axis::X) || !unit)
      return false;
    BlocksBefore way(ctx);
    Block block;
    bool more = way.next(block);
    while (more && isPlain(block) && onlySwitches(dialect, block))
      more = way.next(block);
    if (!more || !isPlain(block) || !liftsOff(dialect, block))
      return false;
    const SourceRange lift = wordsRange(way.unit().source.id(), block);
    // The cut before it: its motion code, and the last X that it gives.
    constexpr unsigned furthest = 20; // blocks
    std::optional<double> cut;
    bool feeds = false;
    for (unsigned i = 0; i < furthest && !(feeds && cut); ++i) {
      if (!way.next(block) || !isPlain(block) || block.hasAny(dialect.incrementWords))
        return false;
      const bool straight = findCode(dialect, block, {Action::Linear});
      if (hasMotionCode(dialect, block) && !straight && !feeds)
        return false;
      if (const Word *word = block.find('X'); word && !cut) {
        if (!word->isNumber() || word->has(wordIncremental) || !onlyFeeds(dialect, block))
          return false;
        cut = word->value() * *unit;
      }
      feeds |= straight;
    }
    const Interval &z = before.at(Axis::Z);
    const bool past = z.isConstant() && z.value() < 0 && !before.inMachineCoordinates(Axis::Z);
    const double most = past ? within : little;
    const double off = cut ? std::fabs(x.value() * diameterFactor(dialect) - *cut) : most + 1;
    if (!feeds || off > most)
      return false;
    if (auto finding = ctx.report(event, !before.may(Fact::UnknownCode)))
      finding
          .message("the tool is changed {0} in X off the last cut: the next one may hit part, "
                   "chuck or clamps",
                   shortLength(ctx, off))
          .note(lift, "nothing but this move has led away from it");
    return true;
  }

  /// A place that the tool has cut: in units of the program, as far as the text gives it.
  struct Place {
    std::optional<double> x, z;
    std::optional<double> from; ///< Z at which the cut to `z` began

    /// How far `to` is from the stretch along Z.
    double besideZ(double to, double unit) const {
      const double a = *z * unit, b = from.value_or(*z) * unit;
      return std::max({std::min(a, b) - to, to - std::max(a, b), 0.0});
    }
    void fill(const Block &block) {
      if (const Word *word = block.find('X'); word && !x)
        x = word->value();
      if (const Word *word = block.find('Z'); word && !z)
        z = word->value();
    }
  };

  /// On a lathe the last rapid move ends close to where the tool has cut last, whatever it did
  /// between: it went away and came back.
  bool nearCut(const Event &event, RuleContext &ctx) const {
    constexpr double nearX = 10, nearZ = 20; // mm, X of the diameter
    const MachineState &before = ctx.before();
    const Interval &x = before.at(Axis::X), &z = before.at(Axis::Z);
    const auto unit = millimetresPer(ctx.dialect(), before);
    const GroupIndex units = ctx.dialect().group(StandardGroup::Units);
    if (units != noGroup && !before.isStated(units))
      return false; // what is 5 mm in one unit is 5 inches in the other
    if (!turns(ctx) || !x.isConstant() || !z.isConstant() || !unit ||
        before.inMachineCoordinates(Axis::X) || before.inMachineCoordinates(Axis::Z) ||
        before.may(Fact::AtMachinePosition))
      return false;
    SourceRange last;
    const Place cut = lastCut(ctx, last);
    if (!cut.x || !cut.z || last.empty() ||
        std::fabs(x.value() * diameterFactor(ctx.dialect()) - *cut.x * *unit) > nearX ||
        cut.besideZ(z.value(), *unit) > nearZ || isForGang(ctx))
      return false;
    if (auto finding = ctx.report(event, false))
      finding
          .message("the tool is changed close to its last cut at X{0} Z{1}: the next one may hit "
                   "part, chuck or clamps",
                   shortNumber(*cut.x), shortNumber(*cut.z))
          .note(last, "this move ends there");
    return true;
  }

  /// How far a program goes at rapid and at feed, in mm and mm of the diameter.
  struct Reach {
    double x = 0, z = 0;

    void take(const Reach &place) {
      x = std::max(x, place.x);
      z = std::max(z, place.z);
    }
  };

  /// The tools are side by side on the slide, and a change turns nothing: there are three or more,
  /// and nowhere does the program take one away from the part. Found out once a program.
  bool isForGang(const RuleContext &ctx) const {
    const uint32_t begin = ctx.index().programAt(ctx.block().begin).begin;
    const auto [known, fresh] =
        memory().goesAway.look().try_emplace(TextPlace{ctx.source().id(), begin}, false);
    if (fresh)
      known->second = goesAway(ctx);
    return !known->second;
  }

  /// Somewhere the program takes its tools away from the part: home, to a machine position, or far
  /// off; or it has too few of them for a gang.
  static bool goesAway(const RuleContext &ctx) {
    constexpr double farZ = 40, farX = 60; // mm beyond what is cut; X of the diameter
    constexpr unsigned most = 20'000;      // blocks; a longer program is for no gang of tools
    constexpr unsigned fewest = 3;         // words of tools
    const Dialect &dialect = ctx.dialect();
    const auto unit = millimetresPer(dialect, ctx.before());
    if (!unit)
      return true;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    Reach at, moved, cut;
    bool rapid = true;
    unsigned seen = 0, tools = 0;
    for (const Block &block : blocks(ctx.index().reader(), program.body, program.end, most)) {
      if (++seen == most || findCode(dialect, block, {Action::ReferenceReturn}) ||
          findCode(dialect, block, {Action::MachineMove}))
        return true;
      tools += block.has(letterAddress('T'));
      if (findCode(dialect, block, {Action::Rapid}))
        rapid = true;
      else if (hasMotionCode(dialect, block))
        rapid = false;
      if (!block.hasAny(dialect.axisWords) || findCode(dialect, block, {Action::PresetPosition}))
        continue;
      if (const Word *word = block.find('X'))
        at.x = word->value() * *unit;
      if (const Word *word = block.find('Z'))
        at.z = word->value() * *unit;
      (rapid ? moved : cut).take(at);
    }
    return tools < fewest || moved.x > cut.x + farX || moved.z > cut.z + farZ;
  }

  /// Where the last cut by a straight line or an arc ended, and the rapid move that is the last one
  /// after it. Nothing where the text does not tell it.
  static Place lastCut(const RuleContext &ctx, SourceRange &last) {
    constexpr unsigned furthest = 40; // blocks
    const Dialect &dialect = ctx.dialect();
    Place place;
    Block block;
    bool cuts = false;
    for (unsigned i = 0; i < furthest && !(cuts && place.x && place.z); ++i) {
      const bool more = i == 0 ? readPrevious(ctx, block) : readBack(ctx, block);
      if (!more || !isPlain(block) || block.has(letterAddress('T')) ||
          findCode(dialect, block, {Action::ReferenceReturn}))
        return {};
      const bool machine = findCode(dialect, block, {Action::MachineMove});
      const bool moves = block.hasAny(dialect.axisWords);
      if (moves && !machine && (!onlyMoves(dialect, block) || !isAbsolute(dialect, block)))
        return {};
      if (last.empty() && moves)
        last = machine ? SourceRange() : wordsRange(ctx, block);
      if (last.empty() && moves)
        return {}; // it changes at a machine position
      if (!cuts && findCode(dialect, block, {Action::Rapid})) {
        place = {};
        continue;
      }
      if (machine)
        return {};
      if (const Word *const begin = block.find('Z'); begin && cuts && place.z && !place.from)
        place.from = begin->value(); // the cut led from there
      place.fill(block);
      cuts |= findCode(dialect, block, {Action::Linear, Action::ArcCw, Action::ArcCcw}) != nullptr;
      if (!cuts && hasMotionCode(dialect, block))
        return {};
    }
    if (!cuts)
      return {};
    if (!place.from)
      place.from = placeBefore(ctx, block);
    return place;
  }

  /// The Z before `block`, as far as the text gives it.
  static std::optional<double> placeBefore(const RuleContext &ctx, Block &block) {
    constexpr unsigned furthest = 20; // blocks
    for (unsigned i = 0; i < furthest && readBack(ctx, block) && isPlain(block); ++i) {
      if (block.has(letterAddress('T')) || block.hasAny(ctx.dialect().incrementWords) ||
          findCode(ctx.dialect(), block, {Action::MachineMove, Action::ReferenceReturn}))
        break;
      if (const Word *word = block.find('Z'))
        return word->isNumber() ? std::optional(word->value()) : std::nullopt;
    }
    return std::nullopt;
  }

  static bool isAbsolute(const Dialect &dialect, const Block &block) {
    return !block.hasAny(dialect.incrementWords) &&
           llvm::all_of(block.words, [&](const Word &word) {
             return !(dialect.axisWords & maskOf(word.address)) ||
                    (word.isNumber() && !word.has(wordIncremental));
           });
  }

  /// Nothing decides at run time whether the block runs, or what.
  static bool isPlain(const Block &block) { return block.items.empty() && block.skip < 0; }

  /// A rapid move in X alone.
  static bool liftsOff(const Dialect &dialect, const Block &block) {
    const Word *x = block.find('X');
    return x && findCode(dialect, block, {Action::Rapid}) &&
           !block.hasAny(dialect.axisWords & ~maskOf('X')) && onlyFeeds(dialect, block);
  }

  /// The axis words are those of a move: only codes of moves, compensation and coolant beside them.
  static bool onlyMoves(const Dialect &dialect, const Block &block) {
    return llvm::all_of(codesOf(dialect, block), [&](const CodeIndex index) {
      return isArc(dialect.codes[index].action) || feedsOrSwitches(dialect.codes[index].action);
    });
  }
  /// The same, without arcs.
  static bool onlyFeeds(const Dialect &dialect, const Block &block) {
    return llvm::all_of(codesOf(dialect, block), [&](const CodeIndex index) {
      return feedsOrSwitches(dialect.codes[index].action);
    });
  }
  static bool feedsOrSwitches(Action action) {
    switch (action) {
    case Action::Rapid:
    case Action::Linear:
    case Action::CompensationOff:
    case Action::CompensationLeft:
    case Action::CompensationRight:
    case Action::CoolantOn:
    case Action::CoolantOff:
      return true;
    default:
      return false;
    }
  }

  /// Codes that move nothing: the cycle's end, the coolant, the spindle.
  static bool onlySwitches(const Dialect &dialect, const Block &block) {
    const llvm::SmallVector<CodeIndex, 6> codes = codesOf(dialect, block);
    return codes.size() == block.words.size() && llvm::all_of(codes, [&](const CodeIndex index) {
             switch (dialect.codes[index].action) {
             case Action::CycleCancel:
             case Action::CoolantOn:
             case Action::CoolantOff:
             case Action::SpindleStop:
             case Action::OptionalStop:
               return true;
             default:
               return false;
             }
           });
  }
};

} // namespace
NCVET_RULE(ToolChangeNearPart, tool_change_near_part)
} // namespace ncvet
