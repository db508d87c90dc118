// An M code that neither this control's table nor the machine profile has.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class BlockUnknownMCode final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::UnknownCode); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.word->address != letterAddress('M') ||
        ctx.find({Action::MacroCall, Action::MacroModal}))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` is neither a code of this control nor named in the machine profile: "
                      "what it does is not known",
                      ctx.text(*event.word));
  }
};

} // namespace
NCVET_RULE(BlockUnknownMCode, block_unknown_m_code)
} // namespace ncvet
