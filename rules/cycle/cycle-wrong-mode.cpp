// A cycle runs under a mode that it does not work in.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

constexpr llvm::StringLiteral id = "cycle-wrong-mode";

class CycleWrongMode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.code == noCode)
      return;
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      return;
    }
    const CodeInfo &code = ctx.code(event);
    if (code.cycle != CycleKind::BackBore ||
        ctx.dialect().group(StandardGroup::ReturnLevel) == noGroup ||
        ctx.after().active(ctx.dialect(), StandardGroup::ReturnLevel) == groupUnset)
      return;
    const Truth toR =
        ctx.after().isActive(ctx.dialect(), StandardGroup::ReturnLevel, {Action::ReturnR});
    if (toR != Truth::Yes)
      return;
    const Word *word = event.word;
    for (const CodeUse &use : ctx.codes())
      if (use.code == event.code)
        word = use.word;
    if (!word)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding
          .message("back boring `{0}` runs with return to R: the tool would stop inside the bore",
                   code.name)
          .note(ctx.after().originOf(ctx.dialect(), StandardGroup::ReturnLevel),
                "return to R is selected here");
  }
};

} // namespace
NCVET_RULE(CycleWrongMode, cycle_wrong_mode)
} // namespace ncvet
