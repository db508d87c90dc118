// A cycle begins below its retraction plane.
#include "analyzer/lookahead.h"

namespace ncvet {
namespace {

class CycleApproachTooLow final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::CycleRun); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (code.cycle != CycleKind::Pocket && code.cycle != CycleKind::Contour)
      return;
    // The retraction plane is the first argument, behind the name of the contour.
    const WordSpec *plane = nullptr;
    for (const WordSpec &spec : code.words)
      if (spec.position && !spec.text && (!plane || spec.position < plane->position))
        plane = &spec;
    const Word *word = plane ? wordFor(ctx.block(), *plane) : nullptr;
    const auto unit = millimetresPer(ctx.dialect(), ctx.before());
    const Axis tool = toolAxis(ctx.dialect(), ctx.before());
    const Interval &from = ctx.before().at(tool);
    if (!word || !unit || !from.isConstant() || ctx.before().inMachineCoordinates(tool))
      return;
    const Interval level = ctx.value(*word);
    if (!level.isConstant() || from.value() >= level.value() * *unit - 1e-6)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding.message("`{0}` begins at {1}, below its retraction plane {2}: the way to its first "
                      "point is not free",
                      code.name, llvm::formatv("{0}", llvm::format("%g", from.value() / *unit)),
                      ctx.text(*word));
  }
};

} // namespace
NCVET_RULE(CycleApproachTooLow, cycle_approach_too_low)
} // namespace ncvet
