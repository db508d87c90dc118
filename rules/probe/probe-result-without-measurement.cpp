// A check of the skip signal without a skip move before it.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ProbeResultWithoutMeasurement final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::SkipCheck});
    again_ = to.dialect().facts->probe.keepsResults;
    if (again_)
      to.on(EventKind::CycleRun);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun)
      return another(event, ctx);
    if (ctx.before().may(Fact::SkipMoveDone) || ctx.after().may(Fact::SkipMoveDone))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` asks about the signal of a skip move, and none was made",
                      ctx.text(*event.word));
  }

private:
  /// The values of the measurement before are used again, at another place.
  static void another(const Event &event, RuleContext &ctx) {
    if (event.code == noCode || ctx.code(event).cycle != CycleKind::Measure)
      return;
    for (const WordSpec &spec : ctx.code(event).words) {
      const Word *word = spec.role == Role::Method ? wordFor(ctx.block(), spec) : nullptr;
      if (!word || !(ctx.value(*word).lo >= 2))
        continue;
      for (unsigned axis = 0; axis < axisCount; ++axis) {
        const Interval &from = ctx.before().position[axis], &to = ctx.after().position[axis];
        if (!(event.axes >> axis & 1) || !from.isConstant() || !to.isConstant() ||
            from.value() == to.value())
          continue;
        if (auto finding = ctx.report(*word))
          finding.severity(Severity::Warning)
              .message("`{0}` uses the values that were measured at another place",
                       ctx.text(*word));
        return;
      }
    }
  }

  bool again_ = false; ///< a cycle may use the values of the one before
};

} // namespace
NCVET_RULE(ProbeResultWithoutMeasurement, probe_result_without_measurement)
} // namespace ncvet
