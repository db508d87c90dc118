// A cancel code of another family than the active cycle's.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class CycleWrongCancel final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::CycleCancel && !code.family.empty();
    });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const CodeInfo *running = ctx.before().activeCode(ctx.dialect(), StandardGroup::Cycle);
    const CodeInfo &code = ctx.code(event);
    if (!running || running->action != Action::Cycle || running->family == code.family)
      return;
    // Another code of the block ends it.
    if (llvm::any_of(ctx.outcome().codes, [&](const CodeUse &use) {
          return ctx.code(use).action == Action::CycleCancel &&
                 ctx.code(use).family == running->family;
        }))
      return;
    const CodeInfo *right =
        running->opposite == noCode ? nullptr : &ctx.dialect().codes[running->opposite];
    if (auto finding = ctx.report(event, !ctx.before().may(Fact::UnknownCode))) {
      finding
          .message("`{0}` does not end `{1}`: it goes on{2}", code.name, running->name,
                   right ? ", and `" + right->name + "` ends it" : std::string())
          .note(ctx.before().origin.of(StatePart::Cycle), running->name + " becomes active here");
      if (right)
        finding.fix(FixSafety::Unsafe, "write `" + right->name + "`",
                    ctx.replace(ctx.range(*event.word), right->name));
    }
  }
};

} // namespace
NCVET_RULE(CycleWrongCancel, cycle_wrong_cancel)
} // namespace ncvet
