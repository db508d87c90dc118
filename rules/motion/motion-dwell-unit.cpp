// The size of a dwell time points to the wrong unit.
#include "analyzer/facts/lookahead.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class MotionDwellUnit final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().dwellInMilliseconds)
      return;
    to.on(EventKind::Dwell);
    if (to.dialect().facts->cycles.dwellInMilliseconds)
      to.on({EventKind::CycleStart, EventKind::CycleRun});
    wholeBelow_ = to.number("wholeBelow", 10);
    pointAbove_ = to.number("pointAbove", 60);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Word *const time = event.kind == EventKind::Dwell ? event.word
                             : event.code == noCode
                                 ? nullptr
                                 : wordOf(ctx.block(), ctx.code(event), Role::Dwell);
    if (!time || !time->isNumber())
      return;
    // Away from a cut a spindle may run warm, and a door may wait.
    const MachineState &before = ctx.before();
    if (event.kind == EventKind::Dwell &&
        (!before.may(Fact::CutSinceTool) || before.must(Fact::AwayFromPart)))
      return;
    const Word &word = *time;
    // `X2` is read as the control reads X: only P changes its unit with the point.
    const AddressKind kind = ctx.dialect().addresses[word.address].kind;
    if (kind == AddressKind::Axis || kind == AddressKind::Increment)
      return;
    const double value = word.value();
    const bool point = word.has(wordPoint);
    if (point ? value <= pointAbove_ : value <= 0 || value >= wholeBelow_)
      return;
    auto finding = ctx.report(word);
    if (!finding)
      return;
    if (point)
      finding.message("`{0}` with a point are seconds: the tool dwells for {1:f1} minutes",
                      ctx.text(word), value / 60);
    else
      finding
          .message("`{0}` without a point are milliseconds: the tool hardly dwells", ctx.text(word))
          .fix(FixSafety::Unsafe, "write the point", ctx.insertBefore(ctx.range(word).end, "."));
  }

private:
  double wholeBelow_ = 10, pointAbove_ = 60;
};

} // namespace
NCVET_RULE(MotionDwellUnit, motion_dwell_unit)
} // namespace ncvet
