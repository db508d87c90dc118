// A cycle is set up without a hole and cancelled before it made one, or its data stand where they
// are lost.
#include "analyzer/lookahead.h"

namespace ncvet {
namespace {

class CycleNeverExecuted final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onChange(
        {EventKind::CycleCancel, EventKind::CycleStart, EventKind::ProgramEnd, EventKind::Block});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &before = ctx.before();
    if (event.kind == EventKind::Block) {
      checkLooseWords(ctx);
      return;
    }
    const CodeInfo *cycle = before.activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (!cycle || cycle->action != Action::Cycle ||
        !(makesHole(cycle->cycle) || cycle->firesInPlane) || before.may(Fact::CycleRan) ||
        before.may(Fact::UnknownCode))
      return;
    if (event.kind == EventKind::CycleStart && &ctx.code(event) == cycle)
      return;
    const Origin &origin = before.origin.cycle;
    if (!origin.known() || origin.file != ctx.source().id())
      return;
    if (auto finding = ctx.report(origin.range()))
      finding.message("`{0}` is set up here and ends without having made a hole", cycle->name)
          .note(ctx.blockRange(), "the cycle ends here");
  }

private:
  /// Depths of pecks and the like in a block that makes no hole.
  void checkLooseWords(RuleContext &ctx) {
    const Block &block = ctx.block();
    constexpr AddressMask data = lettersMask("IJKQEP");
    if (!(block.addresses & data) || block.hasAny(maskOf('G') | maskOf('M')) ||
        !block.items.empty())
      return;
    const CodeInfo *cycle = ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle);
    if (!cycle || cycle->action != Action::Cycle || !makesHole(cycle->cycle))
      return;
    for (const Event &other : ctx.outcome().events)
      if (other.kind == EventKind::CycleRun || other.kind == EventKind::Motion)
        return;
    AddressMask lost = 0;
    for (const WordSpec &spec : cycle->words)
      switch (spec.role) {
      case Role::Peck:
      case Role::PeckFirst:
      case Role::PeckStep:
      case Role::PeckLeast:
      case Role::PeckClearance:
      case Role::Dwell:
      case Role::Shift:
        lost |= spec.any & data;
        break;
      default:
        break;
      }
    const Word *word = block.findAny(lost);
    if (!word)
      return;
    if (auto finding = ctx.report(*word))
      finding
          .message(
              "`{0}` of `{1}` stands in a block that makes no hole: the control does not keep it",
              ctx.text(*word), cycle->name)
          .note(ctx.before().origin.cycle, cycle->name + " becomes active here");
  }
};

} // namespace
NCVET_RULE(CycleNeverExecuted, cycle_never_executed)
} // namespace ncvet
