// A feed whose size belongs to the other feed unit.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class FeedImplausible final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::FeedWord);
    perMinuteBelow_ = to.option("perMinuteBelow", 1);
    perRevolutionAbove_ = to.option("perRevolutionAbove", 5);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &state = ctx.after();
    if (!event.value.isConstant() || event.value.value() <= 0 || state.must(Fact::FeedIsLead) ||
        isLead(ctx))
      return;
    const CodeInfo *mode = state.activeCode(ctx.dialect(), StandardGroup::FeedMode);
    if (!mode)
      return;
    constexpr double millimetresPerInch = 25.4;
    const Truth inch = state.isActive(ctx.dialect(), StandardGroup::Units, {Action::Inch});
    const bool unitKnown = inch != Truth::Unknown ||
                           state.active(ctx.dialect(), StandardGroup::Units) == groupUnset;
    if (!unitKnown)
      return;
    const double feed = event.value.value() * (inch == Truth::Yes ? millimetresPerInch : 1);
    const bool tooSlow = mode->action == Action::FeedPerMinute && feed < perMinuteBelow_;
    const bool tooFast = mode->action == Action::FeedPerRevolution && feed > perRevolutionAbove_;
    if (!tooSlow && !tooFast)
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` under `{1}` is a feed per {2}: its size is that of a feed per {3}",
                      ctx.text(*event.word), mode->name, tooSlow ? "minute" : "revolution",
                      tooSlow ? "revolution" : "minute")
          .note(state.originOf(ctx.dialect(), StandardGroup::FeedMode),
                "`" + mode->name + "` becomes active here");
  }

private:
  /// The F of a threading or tapping block may be a lead.
  static bool isLead(RuleContext &ctx) {
    for (const CodeUse &use : ctx.codes())
      for (const WordSpec &spec : ctx.code(use).words)
        if (spec.role == Role::Lead && (spec.any & maskOf('F')))
          return true;
    return false;
  }

  double perMinuteBelow_ = 1;     // mm/min
  double perRevolutionAbove_ = 5; // mm
};

} // namespace
NCVET_RULE(FeedImplausible, feed_implausible)
} // namespace ncvet
