// A code that switches off what is off already.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ModalRedundantCode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.option("wanted", 0) != 0)
      to.onAction({Action::CompensationOff});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const MachineState &before = ctx.before();
    const CodeInfo &code = ctx.code(event);
    // The first one, and one at the head of a tool's section, makes the state certain.
    if (before.compensation != phaseOff || !before.must(Fact::Cut) ||
        before.may(Fact::UnknownCode) || !before.must(Fact::CutSinceTool) ||
        code.group == noGroup || !(before.statedMust >> code.group & 1) ||
        before.group[code.group] != (uint64_t(1) << code.bit) || isSafeLine(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}`: compensation is off already", code.name)
          .note(before.origin.group[code.group], "since here");
  }

private:
  /// A line of several modes, which states them all whatever they are.
  static bool isSafeLine(const RuleContext &ctx) { return ctx.codes().size() > 2; }
};

} // namespace
NCVET_RULE(ModalRedundantCode, modal_redundant_code)
} // namespace ncvet
