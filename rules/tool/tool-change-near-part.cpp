// A tool change while the tool is in the work or too low.
#include "analyzer/facts/lookahead.h"
#include "formats/text/number_text.h"

#include <cmath>

namespace ncvet {
namespace {

class ToolChangeNearPart final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::ToolChange); }

  void on(const Event &event, RuleContext &ctx) const override {
    const MachineState &before = ctx.before();
    if (before.profile != ProfileMode::Off)
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
    const bool atOnce = ctx.dialect().isLathe() || ctx.dialect().toolChangeByT;
    if (!atOnce || !before.must(Fact::Cut))
      return;
    if (before.may(Fact::AwayFromPart)) {
      afterHole(event, ctx);
      afterCut(event, ctx);
      return;
    }
    if (auto finding = ctx.report(event, !before.may(Fact::UnknownCode)))
      finding.message(
          "the tool is changed where the last cut ended: the next one may hit part, chuck "
          "or clamps");
  }

private:
  /// On a lathe a drilling cycle ends at its R, before the face: nothing has moved since then.
  static void afterHole(const Event &event, RuleContext &ctx) {
    if (!ctx.dialect().isLathe() || ctx.before().may(Fact::AtMachinePosition) ||
        ctx.dialect().group(StandardGroup::ReturnLevel) != noGroup)
      return; // (another control may withdraw to where the cycle began)
    Block block;
    for (bool more = readPrevious(ctx, block); more; more = readBack(ctx, block)) {
      if (!block.items.empty() || block.skip >= 0)
        return; // something else may lead here
      const CodeInfo *cycle = findCode(ctx.dialect(), block, {Action::Cycle});
      if (cycle && makesHole(cycle->cycle)) {
        if (auto finding = ctx.report(event, !ctx.before().may(Fact::UnknownCode)))
          finding
              .message("the tool is changed close to the hole, where `{0}` left it: the next "
                       "one may hit part, chuck or clamps",
                       cycle->name)
              .note(wordsRange(ctx, block), "the hole is drilled here");
        return;
      }
      if (!onlySwitches(ctx.dialect(), block))
        return;
    }
  }

  /// On a lathe the tool was lifted off the cut in X by a little, and has not moved since then.
  static void afterCut(const Event &event, RuleContext &ctx) {
    constexpr double little = 10; // mm of the diameter
    const Dialect &dialect = ctx.dialect();
    const MachineState &before = ctx.before();
    const Interval &x = before.at(Axis::X);
    const auto unit = millimetresPer(dialect, before);
    if (!dialect.isLathe() || before.may(Fact::AtMachinePosition) || !x.isConstant() ||
        before.inMachineCoordinates(Axis::X) || !unit)
      return;
    Block block;
    bool more = readPrevious(ctx, block);
    while (more && isPlain(block) && onlySwitches(dialect, block))
      more = readBack(ctx, block);
    if (!more || !isPlain(block) || !liftsOff(dialect, block))
      return;
    const SourceRange lift = wordsRange(ctx, block);
    // The cut before it: its motion code, and the last X that it gives.
    constexpr unsigned furthest = 20; // blocks
    std::optional<double> cut;
    bool feeds = false;
    for (unsigned i = 0; i < furthest && !(feeds && cut); ++i) {
      if (!readBack(ctx, block) || !isPlain(block) || block.hasAny(dialect.incrementWords))
        return;
      const bool straight = findCode(dialect, block, {Action::Linear});
      if (hasMotionCode(dialect, block) && !straight && !feeds)
        return;
      if (const Word *word = block.find('X'); word && !cut) {
        if (!word->isNumber() || word->has(wordIncremental) || !onlyFeeds(dialect, block))
          return;
        cut = word->value() * *unit;
      }
      feeds |= straight;
    }
    const double way = cut ? std::fabs(x.value() - *cut) : little + 1;
    if (!feeds || way > little)
      return;
    if (auto finding = ctx.report(event, !before.may(Fact::UnknownCode)))
      finding
          .message("the tool is changed {0} mm in X off the last cut: the next one may hit part, "
                   "chuck or clamps",
                   shortNumber(way))
          .note(lift, "nothing but this move has led away from it");
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
  static bool onlyFeeds(const Dialect &dialect, const Block &block) {
    return llvm::all_of(codesOf(dialect, block), [&](const CodeIndex index) {
      switch (dialect.codes[index].action) {
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
    });
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
