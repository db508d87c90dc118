// A measuring cycle without a probe, or with one that is not switched on.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ProbeNotReady final : public Rule {
public:
  /// The tables say the rest; what they say is reported for it.
  void listen(Subscriptions &to) override {
    const auto on = to.machine().option("probeOn");
    if (!on || on->empty())
      return;
    switch_ = to.dialect().find(*on);
    if (switch_ == noCode)
      return;
    to.on(EventKind::CycleStart);
    to.onCode([&](const CodeInfo &code) { return code.base == switch_; });
  }

  void on(const Event &event, RuleContext &ctx) override {
    const CodeInfo &code = ctx.code(event);
    if (event.kind == EventKind::Code) {
      on_ = true;
      return;
    }
    if (on_ || code.cycle != CycleKind::Measure || ctx.callDepth() > 0 ||
        ctx.before().may(Fact::UnknownCode))
      return;
    on_ = true; // said once
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` measures, and nothing has switched the probe on: `{1}` does", code.name,
                   ctx.dialect().codes[switch_].name);
  }
  void remember(RuleMemory &memory) const override { memory(on_); }

private:
  CodeIndex switch_ = noCode; ///< code that switches the probe on, by the machine profile
  bool on_ = false;           ///< it was executed
};

} // namespace
NCVET_RULE(ProbeNotReady, probe_not_ready)
} // namespace ncvet
