// A code that switches off what is off already.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ModalRedundantCode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.option("wanted", 0) != 0)
      to.onAction({Action::CompensationOff});
    if (to.option("emptyBlocks", 0) != 0)
      to.on(EventKind::Block);
    if (to.option("cycleOff", 0) != 0)
      to.onAction({Action::CycleCancel});
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Block)
      return emptyBlock(ctx);
    ctx.reportNotices(id, event);
    if (ctx.code(event).action == Action::CycleCancel)
      return cycleOff(event, ctx);
    if (ctx.code(event).action != Action::CompensationOff)
      return;
    const MachineState &before = ctx.before();
    const CodeInfo &code = ctx.code(event);
    // The first one, and one at the head of a tool's section, makes the state certain.
    if (before.compensation != phaseOff || !before.must(Fact::Cut) ||
        before.may(Fact::UnknownCode) || !before.must(Fact::CutSinceTool) ||
        code.group == noGroup || !(before.statedMust >> code.group & 1) ||
        before.group[code.group] != (uint64_t(1) << code.bit) || isSafeLine(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}`: compensation is off already", code.name)
          .note(before.origin.group[code.group], "since here");
  }

private:
  static constexpr llvm::StringLiteral id{"modal-redundant-code"};

  /// Advice: a block that holds a number and nothing else.
  static void emptyBlock(RuleContext &ctx) {
    const Block &block = ctx.block();
    if (!ctx.asked() || !block.isEmpty() || block.numberEnd <= block.begin ||
        ctx.before().cycleActive(ctx.dialect()) == Truth::Yes)
      return;
    if (auto finding =
            ctx.report(SourceRange{ctx.source().id(), block.numberBegin, block.numberEnd}))
      finding.severity(Severity::Style).message("block `{0}` holds nothing", block.number);
  }

  /// Advice: a cycle is cancelled and none was called.
  static void cycleOff(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    const GroupIndex group = ctx.dialect().group(StandardGroup::Cycle);
    if (!ctx.asked() || ctx.callDepth() > 0 || group == noGroup || before.may(Fact::UnknownCode) ||
        before.statedMay >> group & 1 || !before.must(Fact::Moved) || isSafeLine(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Style)
          .message("`{0}`: no cycle was called before", ctx.code(event).name);
  }

  /// A line of several modes, which states them all whatever they are.
  static bool isSafeLine(const RuleContext &ctx) { return ctx.codes().size() > 2; }
};

} // namespace
NCVET_RULE(ModalRedundantCode, modal_redundant_code)
} // namespace ncvet
