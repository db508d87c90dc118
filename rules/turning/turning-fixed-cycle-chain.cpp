// Increments of successive passes look like a chain, but count from the start point.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/text/number_text.h"

#include <cmath>

namespace ncvet {
namespace {

class TurningFixedCycleChain final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on(EventKind::CycleRun); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || !event.certain)
      return;
    const CodeInfo &code = ctx.code(event);
    const bool face = code.cycle == CycleKind::FacePass;
    if (!face && code.cycle != CycleKind::TurnPass && code.cycle != CycleKind::ThreadPass)
      return sleepInShape();
    for (const CodeUse &use : ctx.codes())
      if (ctx.code(use).action == Action::Cycle)
        return;
    const char letter = face ? 'W' : 'U';
    const Word *word = ctx.block().find(letter);
    const CycleWords &words = ctx.before().cycle;
    if (!word || ctx.dialect().addresses[word->address].kind != AddressKind::Increment ||
        !words.has(letter) || ctx.block().hasAny(face ? lettersMask("XU") : lettersMask("ZW")))
      return;
    const Interval now = ctx.value(*word);
    const double last = words.get(letter);
    if (!now.isConstant() || std::isnan(last) || last == 0 || now.value() == 0 ||
        (now.value() > 0) != (last > 0) || std::fabs(now.value()) > std::fabs(last))
      return;
    // A thread's last pass may be cut twice, against the spring of the tool.
    if (code.cycle == CycleKind::ThreadPass && now.value() == last)
      return;
    if (auto finding = ctx.report(*word))
      finding
          .message("`{0}` counts from the start point of `{1}`, as the {2}{3} before it did: this "
                   "pass is "
                   "not deeper",
                   ctx.text(*word), code.name, std::string(1, letter), shortNumber(last))
          .note(ctx.before().origin.of(StatePart::Cycle), code.name + " becomes active here");
  }
};

} // namespace
NCVET_RULE(TurningFixedCycleChain, turning_fixed_cycle_chain)
} // namespace ncvet
