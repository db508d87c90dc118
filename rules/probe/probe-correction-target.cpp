// A measurement corrects what does not fit it, or what is in use.
#include "analyzer/facts/lookahead.h"

#include <cmath>

namespace ncvet {
namespace {

/// What the correction of a radius, of a length or of an origin ends in is the table's business.
class ProbeCorrectionTarget final : public Rule {
public:
  void listen(Subscriptions &to) override {
    origins_ = to.option("origins", 0) != 0;
    if (origins_)
      to.on({EventKind::CycleRun, EventKind::CoordinateChange});
  }

  /// A measurement corrected the origin that is in force, and the next one counts from it.
  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::CoordinateChange) {
      corrected_ = {};
      return;
    }
    if (event.code == noCode || ctx.code(event).cycle != CycleKind::Measure)
      return;
    const auto what = valueOfRole(ctx, ctx.code(event), Role::Method);
    if (what && *what >= 2) // no touch: the values of the measurement before are used again
      return;
    if (corrected_.end && corrected_.begin != ctx.block().begin) {
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.message("this measurement counts from the origin that the one before has corrected")
            .note(corrected_, "the origin is corrected here");
      corrected_ = {};
      return;
    }
    const auto target = valueOfRole(ctx, ctx.code(event), Role::Offset);
    const CodeInfo *origin = ctx.after().activeCode(ctx.dialect(), StandardGroup::WorkOffset);
    int number = 0;
    if (!what || *what < 1 || !target || !origin || *target != std::floor(*target) ||
        llvm::StringRef(origin->name).rsplit('.').second.getAsInteger(10, number) ||
        number != int(*target))
      return;
    corrected_ = ctx.blockRange();
  }
  void remember(RuleMemory &memory) const override { memory(corrected_); }

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

  bool origins_ = false;  ///< measurements may correct origins by their number
  SourceRange corrected_; ///< the measurement that corrected the origin in force
};

} // namespace
NCVET_RULE(ProbeCorrectionTarget, probe_correction_target)
} // namespace ncvet
