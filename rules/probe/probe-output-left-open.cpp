// The results of measuring go on being written.
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/measuring_series.h"
#include "formats/dialect/variable_key.h"
#include "interp/evaluate/expression.h"

namespace ncvet {
namespace {

struct ProbeOutputLeftOpenMemory {
  SourceRange shown; ///< a measurement whose result is on the screen
  bool said = false; ///< of this series
};

class ProbeOutputLeftOpen final : public StatefulRule<ProbeOutputLeftOpenMemory> {
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

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code && !endsSeries(ctx.code(event), ctx.dialect())) {
      memory().shown = {}; // the message stays until the operator goes on
      return;
    }
    if (event.kind != EventKind::CycleRun) {
      passesBy(ctx);
      memory().said = false;
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
      memory().shown = event.word ? ctx.range(*event.word) : ctx.blockRange();
  }

private:
  /// The next message takes the place of the current one, or the series ends.
  void passesBy(RuleContext &ctx) const {
    if (memory().shown.end && !memory().said)
      if (auto finding = ctx.report(memory().shown))
        finding.message("this measurement only shows its result, and no stop keeps it on the "
                        "screen: M0 or M1 after it does");
    memory().said |= memory().shown.end != 0;
    memory().shown = {};
  }
};

} // namespace
NCVET_RULE(ProbeOutputLeftOpen, probe_output_left_open)
} // namespace ncvet
