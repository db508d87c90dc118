// More decimal places than the control resolves.
#include "analyzer/rule/rule.h"

namespace ncvet {
namespace {

class StyleExcessDigits final : public Rule {
public:
  void listen(Subscriptions &to) override {
    metric_ = uint8_t(to.number("digits", 3));
    to.on(EventKind::Block);
  }

  void on(const Event &, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    const Dialect &dialect = ctx.dialect();
    if (!(block.pointed & ~dialect.whole))
      return;
    for (const Word &word : block.words) {
      if (word.decimals <= metric_ || !word.isNumber())
        continue;
      const AddressInfo &address = dialect.addresses[word.address];
      if (address.unit != AddressUnit::Length && address.unit != AddressUnit::Angle)
        continue;
      // An inch value is resolved one digit finer.
      const unsigned digits =
          metric_ +
          (ctx.after().activeAction(dialect, StandardGroup::Units) == Action::Metric ? 0u : 1u);
      if (word.decimals <= digits || trailingZeros(word) >= word.decimals - digits)
        continue;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` has {1} decimal places: the control rounds it to {2}",
                        ctx.text(word), unsigned(word.decimals), digits);
    }
  }

private:
  static unsigned trailingZeros(const Word &word) {
    unsigned zeros = 0;
    for (int64_t m = word.mantissa; m && m % 10 == 0; m /= 10)
      ++zeros;
    return word.mantissa ? zeros : word.decimals;
  }

  uint8_t metric_ = 3;
};

} // namespace
NCVET_RULE(StyleExcessDigits, style_excess_digits)
} // namespace ncvet
