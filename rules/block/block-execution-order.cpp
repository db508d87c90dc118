// Words of a block that take effect in another order, or by another code, than they seem to.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

namespace ncvet {
namespace {

class BlockExecutionOrder final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    to.onAction({Action::CycleCancel});
    to.on(EventKind::CycleRun);
    if (to.flag("statements"))
      to.on(EventKind::Statement);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun)
      return repeated(event, ctx);
    if (event.kind == EventKind::Statement)
      return jump(ctx.block().items[event.item()], ctx);
    ctx.reportNotices(id, event);
    if (!asksNumbers(ctx.code(event), id)) // the rest looks at codes and addresses alone
      sleepInShape();
    if (ctx.code(event).action == Action::CycleCancel)
      cancelWithAxes(event, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"block-execution-order"};

  /// A jump, a repeat or a prompt with its way out beside a move.
  static void jump(const Item &item, RuleContext &ctx) {
    if (item.kind != ItemKind::Jump && item.kind != ItemKind::Repeat &&
        item.kind != ItemKind::Input)
      return;
    if (!ctx.block().hasAny(ctx.dialect().axisWords))
      return;
    const SourceRange range = ctx.range(item);
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Style)
          .message("`{0}` in a block with a move: which of the two comes first is not stated",
                   ctx.text(range));
  }

  /// An M code beside a repeated cycle acts once, after the first positioning.
  static void repeated(const Event &event, RuleContext &ctx) {
    if (event.code == noCode || !ctx.block().has(letterAddress('M')))
      return sleepInShape();
    for (const WordSpec &spec : ctx.code(event).words) {
      if (spec.role != Role::Repeat)
        continue;
      const Word *count = wordFor(ctx.block(), spec);
      if (!count || !(ctx.value(*count).lo > 1))
        continue;
      const Word &code = *ctx.block().find('M');
      if (auto finding = ctx.report(code, event.certain))
        finding.message(
            "`{0}` acts once, after the first positioning, not for every repeat of `{1}`",
            ctx.text(code), ctx.text(*count));
    }
  }

  /// Axis words beside the code that ends a cycle move by the motion code from before the cycle.
  static void cancelWithAxes(const Event &event, RuleContext &ctx) {
    const Word *axis = ctx.block().findAny(ctx.dialect().axisWords);
    if (!axis || ctx.dialect().cycleSurvivesMotion) // the motion code has never been out of force
      return;
    for (const CodeUse &use : ctx.codes()) {
      const CodeInfo &code = ctx.code(use);
      // Another code of the block says what the axis words mean.
      if (use.word != event.word && (isMotion(code.action) || code.action == Action::Cycle ||
                                     code.exclusive || code.takes & ctx.dialect().axisWords))
        return;
    }
    if (auto finding = ctx.report(*axis, event.certain))
      finding
          .message(
              "`{0}` beside `{1}` moves with the motion code that was in force before the cycle",
              ctx.text(*axis), ctx.text(*event.word))
          .severity(Severity::Style);
  }
};

} // namespace
NCVET_RULE(BlockExecutionOrder, block_execution_order)
} // namespace ncvet
