// A G code that this control's table does not have.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class BlockUnknownGCode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::UnknownCode);
    whole_ = to.dialect().facts->text.wholeCodes == 1;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.word->address != letterAddress('G') || (whole_ && event.word->decimals > 0) ||
        ctx.find({Action::MacroCall, Action::MacroModal}))
      return;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` does not exist on this control: the block is refused",
                      ctx.text(*event.word));
  }

private:
  bool whole_ = false; ///< a code with decimals is no whole number, as another rule says
};

} // namespace
NCVET_RULE(BlockUnknownGCode, block_unknown_g_code)
} // namespace ncvet
