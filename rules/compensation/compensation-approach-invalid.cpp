// Corner and vector codes of compensation (G38, G39) where they cannot work.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class CompensationApproachInvalid final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::CompensationKeep, Action::CompensationCorner});
    to.onNotices(id);
  }

  void on(const Event &event, RuleContext &ctx) override {
    const CodeInfo &code = ctx.code(event);
    ctx.reportNotices(id, event);
    if (code.action != Action::CompensationKeep && code.action != Action::CompensationCorner)
      return;
    const Truth active = ctx.after().compensationActive(ctx.dialect());
    if (active == Truth::No) {
      if (auto finding = ctx.report(event, !ctx.after().may(Fact::UnknownCode)))
        finding.message("`{0}` without radius compensation: the control stops with an alarm",
                        code.name);
      return;
    }
    if (code.action == Action::CompensationKeep)
      keep(code, event, ctx);
    else
      corner(code, event, ctx);
  }

private:
  static constexpr llvm::StringLiteral id{"compensation-approach-invalid"};
  static void keep(const CodeInfo &code, const Event &event, RuleContext &ctx) {
    const CodeInfo *motion = ctx.after().activeCode(ctx.dialect(), StandardGroup::Motion);
    if (!motion || !isArc(motion->action))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` under `{1}`: the vector can be kept on straight moves only, the control "
                   "stops with an alarm",
                   code.name, motion->name)
          .note(ctx.after().originOf(ctx.dialect(), StandardGroup::Motion),
                "`" + motion->name + "` becomes active here");
  }

  static void corner(const CodeInfo &code, const Event &event, RuleContext &ctx) {
    const AddressMask own = lettersMask("GIJK");
    for (const Word &word : ctx.block().words) {
      const bool foreign = !(own & maskOf(word.address)) ||
                           (word.address == letterAddress('G') && &word != event.word);
      if (!foreign)
        continue;
      if (auto finding = ctx.report(event))
        finding.message("`{0}` wants a block of its own, with I, J and K only; here it stands with "
                        "`{1}`",
                        code.name, ctx.text(word));
      return;
    }
  }
};

} // namespace
NCVET_RULE(CompensationApproachInvalid, compensation_approach_invalid)
} // namespace ncvet
