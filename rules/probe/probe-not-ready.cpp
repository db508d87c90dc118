// A measuring cycle without a probe, or with one that is not switched on.
#include "analyzer/rule/rule.h"

#include "llvm/ADT/StringExtras.h"

namespace ncvet {
namespace {

struct ProbeNotReadyMemory {
  bool on = false;       ///< the probe was switched on
  bool off = false;      ///< … and off since
  bool measured = false; ///< a measuring cycle ran
  bool lost = false;     ///< a program was called that is not known
};

class ProbeNotReady final : public StatefulRule<ProbeNotReadyMemory> {
public:
  /// The tables say the rest; what they say is reported for it.
  void listen(Subscriptions &to) override {
    switchOn_ = Switch(to.machine().option("probeOn"));
    switchOff_ = Switch(to.machine().option("probeOff"));
    if (switchOn_.known() || switchOff_.known())
      to.on({EventKind::Block, EventKind::CycleStart, EventKind::ProgramEnd, EventKind::FlowIssue});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    switch (event.kind) {
    case EventKind::Block:
      for (const Word &word : ctx.block().words) {
        memory().on |= switchOn_.is(word);
        memory().off = switchOff_.is(word) || (memory().off && !switchOn_.is(word));
      }
      return;
    case EventKind::FlowIssue: // a program that is not there may do it
      memory().lost |= event.flowIssue() == FlowIssue::UnknownProgram;
      return;
    case EventKind::CycleStart:
      if (event.code != noCode && ctx.code(event).cycle == CycleKind::Measure)
        measures(event, ctx);
      return;
    default:
      if (!switchOff_.known() || memory().off || memory().lost || ctx.callDepth() > 0 ||
          !(memory().measured || (memory().on && switchOn_.known())))
        return;
      memory().off = true; // said once
      if (auto finding = ctx.report(event))
        finding.severity(Severity::Warning)
            .message("the program ends with the probe switched on: `{0}` switches it off",
                     switchOff_.name);
    }
  }

private:
  /// A G or M code of the machine, by its profile: the tables need not know it.
  struct Switch {
    Switch() = default;
    explicit Switch(std::optional<llvm::StringRef> text) {
      llvm::StringRef digits = text.value_or("").trim();
      uint32_t whole = 0;
      if (digits.empty() || !llvm::isAlpha(digits[0]) ||
          digits.drop_front().getAsInteger(10, whole))
        return;
      name = digits.upper();
      letter = letterAddress(name[0]);
      number = whole * 10;
    }
    bool known() const { return letter != noAddress; }
    bool is(const Word &word) const {
      return known() && word.address == letter && word.isNumber() && word.codeNumber() == number;
    }

    std::string name;
    AddressId letter = noAddress;
    uint32_t number = 0; ///< times ten, as words have it
  };

  void measures(const Event &event, RuleContext &ctx) const {
    memory().measured = true;
    if (memory().on || !switchOn_.known() || memory().lost || ctx.callDepth() > 0)
      return;
    memory().on = true; // said once
    if (auto finding = ctx.report(event))
      finding.severity(Severity::Warning)
          .message("`{0}` measures, and nothing has switched the probe on: `{1}` does",
                   ctx.code(event).name, switchOn_.name);
  }

  Switch switchOn_;
  Switch switchOff_;
};

} // namespace
NCVET_RULE(ProbeNotReady, probe_not_ready)
} // namespace ncvet
