// A check of the skip signal without a skip move before it.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

#include <set>

namespace ncvet {
namespace {

struct ProbeResultWithoutMeasurementMemory {
  std::set<CodeIndex> measured; ///< cycles that have measured so far
};

class ProbeResultWithoutMeasurement final
    : public StatefulRule<ProbeResultWithoutMeasurementMemory> {
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
  void another(const Event &event, RuleContext &ctx) const {
    if (event.code == noCode || ctx.code(event).cycle != CycleKind::Measure)
      return;
    for (const WordSpec &spec : ctx.code(event).words) {
      const Word *word = spec.role == Role::Method ? wordFor(ctx.block(), spec) : nullptr;
      if (word && ctx.value(*word).hi < 2)
        memory().measured.insert(ctx.code(event).base);
      if (!word || !(ctx.value(*word).lo >= 2))
        continue;
      if (ofOther(*word, event, ctx))
        return;
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

  /// Only other cycles have measured so far; where none has, the table speaks.
  bool ofOther(const Word &word, const Event &event, RuleContext &ctx) const {
    if (memory().measured.empty() || memory().measured.count(ctx.code(event).base) ||
        ctx.callDepth() > 0 || ctx.before().may(Fact::UnknownCode))
      return false;
    if (auto finding = ctx.report(word))
      finding.severity(Severity::Warning)
          .message("`{0}` uses the values of a measurement before it, and `{1}` has made none",
                   ctx.text(word), ctx.code(event).name);
    return true;
  }

  bool again_ = false; ///< a cycle may use the values of the one before
};

} // namespace
NCVET_RULE(ProbeResultWithoutMeasurement, probe_result_without_measurement)
} // namespace ncvet
