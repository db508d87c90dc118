// A length, angle or feed without a decimal point on a control that may scale such a value.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class SyntaxMissingDecimalPoint final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().pointAdvised)
      to.on(EventKind::WordIssue);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.wordIssue() != WordIssue::NoPoint)
      return;
    // With this setting the control reads whole numbers as they are meant.
    if (const auto reading = ctx.machine().option("decimalPoint");
        reading && *reading == "calculator")
      return;
    for (const Word &word : ctx.block().words) {
      const bool pointless = word.isNumber() && !word.has(wordPoint) && word.mantissa;
      if (!pointless || !(ctx.dialect().pointAdvised & maskOf(word.address)) ||
          !advised(word.address, ctx))
        continue;
      if (auto finding = ctx.report(word))
        finding
            .message("`{0}` has no decimal point: the control may read it as {1} thousandths",
                     ctx.text(word), word.mantissa)
            .fix(FixSafety::Unsafe, "add the decimal point",
                 ctx.insertBefore(ctx.block().endOf(word), "."));
    }
  }

private:
  /// What the block's codes, else the active cycle, else the address itself say.
  static bool advised(AddressId address, const RuleContext &ctx) {
    const auto says = [&](const CodeInfo &code) -> std::optional<bool> {
      for (const WordSpec &spec : code.words)
        if (spec.any & maskOf(address) && spec.pointAdvised)
          return spec.pointAdvised;
      return std::nullopt;
    };
    for (const CodeUse &use : ctx.codes())
      if (const auto said = says(ctx.code(use)))
        return *said;
    for (const StandardGroup group : {StandardGroup::Cycle, StandardGroup::Motion})
      if (const CodeInfo *active = ctx.before().activeCode(ctx.dialect(), group))
        if (const auto said = says(*active))
          return *said;
    return ctx.dialect().addresses[address].pointAdvised;
  }
};

} // namespace
NCVET_RULE(SyntaxMissingDecimalPoint, syntax_missing_decimal_point)
} // namespace ncvet
