// The repeat count of a call is not a whole number of runs.
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/expression.h"

#include <cmath>

namespace ncvet {
namespace {

class FlowRepeatCount final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::CallProgram, Action::CallLocal, Action::MacroCall});
    to.on(EventKind::Statement);
    usual_ = to.number("usual", 0);
    greatest_ = to.dialect().facts->limits.repeats;
    whole_ = to.dialect().facts->limits.repeatsWhole;
    wholeText_ = to.dialect().facts->text.wholeCodes == 1;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return atStatement(ctx.block().items[event.item()], ctx);
    const Word *count = ctx.block().find('L');
    if (!count || count->has(wordNoValue))
      return sleepInShape();
    const Interval value = ctx.value(*count);
    if (!value.isConstant())
      return;
    const double runs = value.value();
    if (runs >= 1 && runs == std::floor(runs)) {
      if (ctx.text(*count).drop_front().ltrim().startswith("+"))
        if (auto finding = ctx.report(*count))
          finding.severity(Severity::Warning)
              .message("`{0}` has a sign before the number of runs, which is none of `{1}`",
                       ctx.text(*count), ctx.code(event).name);
      return;
    }
    // None on purpose: a call that is switched off for a while, or by a computed count.
    const bool none = runs == 0;
    if (none && count->has(wordExpression))
      return;
    if (auto finding = ctx.report(*count))
      finding.message("`{0}` is no number of runs for `{1}`: {2}", ctx.text(*count),
                      ctx.code(event).name,
                      none ? "the control makes none, or one all the same"
                           : "it has to be a whole number from 1 on");
  }

private:
  /// A call by name, or a section that is repeated.
  void atStatement(const Item &item, RuleContext &ctx) const {
    if ((item.kind != ItemKind::Call && item.kind != ItemKind::Repeat) ||
        item.count == noExpression)
      return sleepAtBlock();
    const Expression &count = ctx.block().expressions[item.count];
    const Value value = evaluateInBlock(ctx.block(), item.count, ctx.before());
    if (!value.isConstant())
      return notWhole(item, count, ctx);
    const double runs = value.number.value();
    const bool plain = count.count == 1;
    const bool computed =
        !plain || ctx.block().operations[count.first].op != Op::Number; // the text shows no number
    const SourceRange range = ctx.range(count);
    if (!computed && item.kind == ItemKind::Call && wholeText_ && runs != std::floor(runs))
      return; // syntax-integer-required speaks
    const bool none = runs < 1 && (plain || runs < 0 || whole_);
    const bool broken = none || runs != std::floor(runs) || (greatest_ > 0 && runs > greatest_);
    if (!broken && (usual_ == 0 || runs <= usual_ || item.kind == ItemKind::Repeat))
      return;
    if (auto finding = ctx.report(range)) {
      finding.message(none     ? "`{0}` is no number of runs: it has to be 1 at least"
                      : broken ? plain && !computed
                                     ? "`{0}` is no number of runs that the control makes"
                                     : "`{0}` is {1}: no number of runs that the control makes"
                               : "`{0}` runs are more than is usual: smaller controls refuse it",
                      ctx.text(range), runs);
      if (!broken)
        finding.severity(Severity::Warning);
    }
  }

  /// A real variable whose value is not known, where the control wants a whole number made of it.
  void notWhole(const Item &item, const Expression &count, RuleContext &ctx) const {
    if (!whole_ || item.kind != ItemKind::Repeat || count.bad)
      return;
    bool real = false;
    for (const ExpressionOp &op :
         llvm::makeArrayRef(ctx.block().operations).slice(count.first, count.count)) {
      real |= op.op == Op::Variable && ctx.source().text(op.offset, op.offset + 1) != "%";
      if (op.op == Op::Fix || op.op == Op::Truncate || op.op == Op::Round || op.op == Op::Opaque)
        return;
    }
    const SourceRange range = ctx.range(count);
    if (!real)
      return;
    if (auto finding = ctx.report(range))
      finding.severity(Severity::Warning)
          .message("`{0}` is a real number: a count is made whole by a function, as FTI",
                   ctx.text(range));
  }

  bool wholeText_ = false; ///< numbers that name something are written whole
  bool whole_ = false;     ///< a repeat needs a whole number from 1 on, however it is computed
  double usual_ = 0, greatest_ = 0; ///< 0: not limited; the first is one of calls
};

} // namespace
NCVET_RULE(FlowRepeatCount, flow_repeat_count)
} // namespace ncvet
