// I, J and K of a macro call are in an order in which the control reads them as others.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class FlowMacroArgumentOrder final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onAction({Action::MacroCall, Action::MacroModal}); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (!event.word)
      return;
    char last = 0;
    const Word *wrong = nullptr;
    unsigned seen = 0; // bit per letter
    bool repeated = false;
    for (const Word &word : ctx.block().words) {
      if (word.address < letterAddress('I') || word.address > letterAddress('K') ||
          word.offset < event.word->offset)
        continue;
      const auto letter = char('A' + word.address);
      repeated |= seen >> (letter - 'I') & 1;
      seen |= 1u << (letter - 'I');
      if (letter < last && !wrong)
        wrong = &word;
      last = letter;
    }
    // A letter that comes twice means the list of several I, J and K: its order is meant.
    if (!wrong || repeated)
      return;
    if (auto finding = ctx.report(*wrong))
      finding.message("`{0}` comes after a later letter: the control takes it for the I, J or K of "
                      "the next set, and puts it into another variable",
                      ctx.text(*wrong));
  }
};

} // namespace
NCVET_RULE(FlowMacroArgumentOrder, flow_macro_argument_order)
} // namespace ncvet
