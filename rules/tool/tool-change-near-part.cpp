// A tool change where the tool stands in the work or too low.
#include "analyzer/lookahead.h"

namespace ncvet {
namespace {

class ToolChangeNearPart final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::ToolChange); }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &before = ctx.before();
    if (before.profile != 0)
      return;
    if (const auto lowest = ctx.machine().number("toolChangeMinZ")) {
      const Interval &z = before.at(Axis::Z);
      if (z.isConstant() && !before.inMachineCoordinates(Axis::Z) &&
          before.must(Fact::MovedSinceTool) && z.value() < *lowest) {
        if (auto finding = ctx.report(event))
          finding.message("the tool is changed at Z{0}, below the safe Z{1}",
                          llvm::format("%g", z.value()), llvm::format("%g", *lowest));
        return;
      }
    }
    // With M06 a machining centre takes the tool to its own change position.
    const bool atOnce = ctx.dialect().isLathe() || ctx.dialect().toolChangeByT;
    if (!atOnce || !before.must(Fact::Cut))
      return;
    if (before.may(Fact::AwayFromPart))
      return behindHole(event, ctx);
    if (auto finding = ctx.report(event, !before.may(Fact::UnknownCode)))
      finding.message(
          "the tool is changed where the last cut ended: the next one may hit part, chuck "
          "or clamps");
  }

private:
  /// On a lathe a drilling cycle ends at its R, in front of the face: nothing has moved since then.
  static void behindHole(const Event &event, RuleContext &ctx) {
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
              .message("the tool is changed in front of the hole, where `{0}` left it: the next "
                       "one may hit part, chuck or clamps",
                       cycle->name)
              .note(wordsRange(ctx, block), "the hole is drilled here");
        return;
      }
      if (!onlySwitches(ctx.dialect(), block))
        return;
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
