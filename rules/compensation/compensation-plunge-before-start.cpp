// A cutter that is fed down to depth before compensation is switched on.
#include "analyzer/facts/path_ahead.h"
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CompensationPlungeBeforeStart final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().isLathe())
      to.on(EventKind::CompensationMove);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.code(event).action == Action::CompensationOff ||
        !ctx.before().must(Fact::PlungedUncompensated))
      return;
    if (isInCircle(ctx))
      return;
    const CodeUse *use = ctx.find({Action::CompensationLeft, Action::CompensationRight});
    const SourceRange where = use ? ctx.range(*use->word) : ctx.blockRange();
    if (auto finding = ctx.report(where, event.certain))
      finding.message(
          "`{0}` comes when the tool is fed down to depth already: it went in beside the "
          "place where compensation puts it",
          ctx.code(event).name);
  }

private:
  /// The move leads from inside of the circle that is milled next out to it: down in the middle of
  /// a bore nothing is spoilt.
  static bool isInCircle(const RuleContext &ctx) {
    const Interval &x = ctx.before().at(Axis::X), &y = ctx.before().at(Axis::Y);
    PathAhead ahead(ctx);
    if (!x.isConstant() || !y.isConstant() || !ahead.next())
      return false;
    const auto circle = contourElementOf(ahead.executed());
    constexpr double inside = 0.99; // of the radius
    return circle && circle->arc &&
           (Vector(x.value(), y.value()) - circle->centre).norm() < inside * circle->radius();
  }
};

} // namespace
NCVET_RULE(CompensationPlungeBeforeStart, compensation_plunge_before_start)
} // namespace ncvet
