// With incremental repeats the place where the cycle is called gets no hole.
#include "analyzer/lookahead.h"

#include <cmath>

namespace ncvet {
namespace {

class CycleHoleAtDefinition final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::CycleStart); }

  void on(const Event &event, RuleContext &ctx) override {
    const CodeInfo &code = ctx.code(event);
    const auto count = valueOf(ctx, code, Role::Repeat);
    if (!makesHole(code.cycle) || !count || *count < 2)
      return;
    const Dialect &dialect = ctx.dialect();
    const Axis tool = toolAxis(dialect, ctx.after());
    const GroupIndex group = dialect.group(StandardGroup::Distance);
    const bool allIncremental =
        group != noGroup && ctx.after().group[group] != groupUnset &&
        ctx.after().isActive(dialect, StandardGroup::Distance, {Action::Incremental}) == Truth::Yes;
    const auto unit = millimetresPer(dialect, ctx.after());
    if (!unit)
      return;
    bool stepping = false;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = dialect.addresses[word.address];
      if (!(dialect.axisWords & maskOf(word.address)) || address.axis == tool)
        continue;
      if (!allIncremental && address.kind != AddressKind::Increment && !word.has(wordIncremental))
        return;
      const Interval step = ctx.value(word);
      const Interval &from = ctx.before().at(address.axis);
      if (!step.isConstant() || !from.isConstant() || step.value() == 0)
        return;
      // Whoever stands a whole number of steps from the origin stands on a hole of the pattern.
      const double steps = from.value() / (step.value() * *unit);
      if (steps < 0.5 || std::fabs(steps - std::round(steps)) > 1e-6)
        return;
      stepping = true;
    }
    if (!stepping || ctx.before().cycleActive(dialect) != Truth::No)
      return;
    if (auto finding = ctx.report(event, false))
      finding.message("`{0}` makes its first of {1} holes one step away: the place where the tool "
                      "stands gets none",
                      code.name, *count);
  }
};

} // namespace
NCVET_RULE(CycleHoleAtDefinition, cycle_hole_at_definition)
} // namespace ncvet
