// The side step of a grooving cycle is wider than the insert, or leaves an uneven last step.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "formats/text/number_text.h"

#include <cmath>

namespace ncvet {
namespace {

class CycleStepoverTooWide final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    to.onNotices(id);
    evenSteps_ = to.flag("evenSteps", true);
    stepUnit_ = to.dialect().facts->turning.stepUnit;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    if (event.kind == EventKind::Code)
      return ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    const bool face = code.cycle == CycleKind::GrooveFace;
    if (!face && code.cycle != CycleKind::GrooveRadial)
      return sleepInShape();
    const Word *word = wordOf(ctx.block(), code, Role::Step);
    const auto value = valueOf(ctx, code, Role::Step);
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    if (!word || !value || !unit || *value <= 0)
      return;
    const double scale = word->has(wordPoint) ? 1 : stepUnit_;
    const double step = *value * *unit * scale;
    const Axis axis = face ? Axis::X : Axis::Z;
    const Interval &start = ctx.before().at(axis);
    const auto end =
        ctx.before().inMachineCoordinates(axis) ? std::nullopt : endOf(ctx, axis, start);
    // Along X the step is a radius, the coordinates are diameters.
    const double factor = face ? 0.5 : 1;
    if (!end || !start.isConstant())
      return;
    const double width = std::fabs(*end - start.value()) * factor;
    if (width < 1e-6)
      return;
    const auto tool = ctx.machine().tools.find(ctx.after().tool);
    if (tool != ctx.machine().tools.end() && tool->second.width &&
        step > *tool->second.width + 1e-6) {
      if (auto finding = ctx.report(*word, event.certain))
        finding.message(
            "the step `{0}` of `{1}` is wider than the insert ({2} mm): ridges stay between "
            "the grooves",
            ctx.text(*word), code.name, *tool->second.width);
      return;
    }
    const double steps = width / step;
    if (!evenSteps_ || steps < 1 || std::fabs(steps - std::round(steps)) < 1e-4)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding
          .message(
              "the step `{0}` of `{1}` does not divide the width {2}: the last step is smaller",
              ctx.text(*word), code.name, shortNumber(width / *unit))
          .severity(Severity::Style);
  }

private:
  static constexpr llvm::StringLiteral id{"cycle-stepover-too-wide"};
  double stepUnit_ = 1;
  bool evenSteps_ = true; ///< a last step that is smaller is told
};

} // namespace
NCVET_RULE(CycleStepoverTooWide, cycle_stepover_too_wide)
} // namespace ncvet
