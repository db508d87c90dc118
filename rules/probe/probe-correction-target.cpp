// A measurement corrects what does not fit it, or what is in use.
#include "analyzer/facts/lookahead.h"
#include "formats/dialect/control_facts.h"

#include <cmath>

namespace ncvet {
namespace {

struct ProbeCorrectionTargetMemory {
  SourceRange corrected; ///< the measurement that corrected what is in force
  bool tool = false;     ///< that was the tool in the spindle, not the origin
};

/// What the correction of a radius, of a length or of an origin ends in is the table's business.
class ProbeCorrectionTarget final : public StatefulRule<ProbeCorrectionTargetMemory> {
public:
  void listen(Subscriptions &to) override {
    origins_ = to.dialect().facts->probe.correctsOrigins;
    if (origins_)
      to.on({EventKind::CycleRun, EventKind::CoordinateChange});
  }

  /// A measurement corrected the origin that is in force, and the next one counts from it.
  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CoordinateChange) {
      memory().corrected = {};
      return;
    }
    if (event.code == noCode || ctx.code(event).cycle != CycleKind::Measure)
      return;
    const auto what = valueOfRole(ctx, ctx.code(event), Role::Method);
    if (what && *what >= 2) // no touch: the values of the measurement before are used again
      return;
    if (memory().corrected.end && memory().corrected.begin != ctx.block().begin) {
      if (auto finding = ctx.report(ctx.blockRange()))
        finding
            .message("this measurement counts {0} that the one before has corrected",
                     memory().tool ? "with the tool in the spindle" : "from the origin")
            .note(memory().corrected, "it is corrected here");
      memory().corrected = {};
      return;
    }
    const auto target = valueOfRole(ctx, ctx.code(event), Role::Offset);
    if (what && *what >= 1 && target && *target > 0 && *target != std::floor(*target) &&
        std::floor(*target) == double(ctx.after().tool)) {
      memory().corrected = ctx.blockRange();
      memory().tool = true;
      return;
    }
    const CodeInfo *origin = ctx.after().activeCode(ctx.dialect(), StandardGroup::WorkOffset);
    int number = 0;
    memory().tool = false;
    if (!what || *what < 1 || !target || !origin || *target != std::floor(*target) ||
        llvm::StringRef(origin->name).rsplit('.').second.getAsInteger(10, number) ||
        number != int(*target))
      return;
    memory().corrected = ctx.blockRange();
  }

private:
  static std::optional<double> valueOfRole(RuleContext &ctx, const CodeInfo &code, Role role) {
    for (const WordSpec &spec : code.words) {
      if (spec.role != role || !spec.variable)
        continue;
      const Value value = ctx.after().commons.get(spec.variable);
      return value.isConstant() ? std::optional(value.number.value()) : std::nullopt;
    }
    return std::nullopt;
  }

  bool origins_ = false; ///< measurements may correct origins by their number
};

} // namespace
NCVET_RULE(ProbeCorrectionTarget, probe_correction_target)
} // namespace ncvet
