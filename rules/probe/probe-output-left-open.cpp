// The results of measuring go on being written.
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/measuring_series.h"
#include "formats/dialect/variable_key.h"
#include "interp/evaluate/expression.h"

namespace ncvet {
namespace {

class ProbeOutputLeftOpen final : public Rule {
public:
  /// What is left open the tables say; a result that nobody can read is looked for here.
  void listen(Subscriptions &to) override {
    const bool series = llvm::any_of(
        to.dialect().codes, [&](const CodeInfo &code) { return endsSeries(code, to.dialect()); });
    if (!series)
      return;
    to.on({EventKind::CycleRun, EventKind::ProgramEnd});
    to.onAction({Action::ProgramStop, Action::OptionalStop});
    to.onCode([&](const CodeInfo &code) { return endsSeries(code, to.dialect()); });
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Code && !endsSeries(ctx.code(event), ctx.dialect())) {
      shown_ = {}; // the message stays until the operator goes on
      return;
    }
    if (event.kind != EventKind::CycleRun) {
      passesBy(ctx);
      said_ = false;
      return;
    }
    if (event.code == noCode || ctx.code(event).cycle != CycleKind::Measure)
      return;
    passesBy(ctx);
    const auto method = kept(ctx.after(), ctx.code(event), Role::Method);
    const Value stored = readVariable(ctx.after(), int64_t(variableKey("PRT")));
    const bool isStored = stored.kind != Value::Kind::Vacant && !(stored == Value::of(0));
    if (method && *method < 1 && !isStored &&
        !ctx.find({Action::ProgramStop, Action::OptionalStop}))
      shown_ = event.word ? ctx.range(*event.word) : ctx.blockRange();
  }
  void remember(RuleMemory &memory) const override { memory(shown_, said_); }

private:
  /// The next message takes the place of the one at hand, or the series ends.
  void passesBy(RuleContext &ctx) {
    if (shown_.end && !said_)
      if (auto finding = ctx.report(shown_))
        finding.message("this measurement only shows its result, and no stop keeps it on the "
                        "screen: M0 or M1 behind it does");
    said_ |= shown_.end != 0;
    shown_ = {};
  }

  SourceRange shown_; ///< a measurement whose result is on the screen
  bool said_ = false; ///< of this series
};

} // namespace
NCVET_RULE(ProbeOutputLeftOpen, probe_output_left_open)
} // namespace ncvet
