// A corner in which the control stops with an alarm when it runs block by block.
#include "analyzer/facts/corner_words.h"

namespace ncvet {
namespace {

class ContourCornerSingleBlock final : public Rule {
public:
  void listen(Subscriptions &to) override {
    // Only controls that write corners with a comma are known to do so.
    words_ = cornerAddresses(to.dialect()).corner() & (maskOf(commaC) | maskOf(commaR));
    if (words_)
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Word *word = ctx.block().findAny(words_);
    if (!word || !event.certain || event.motion == MotionKind::Rapid)
      return;
    if (auto finding = ctx.report(*word))
      finding.message("`{0}`: in single-block mode the control stops after this corner with an "
                      "alarm",
                      ctx.text(*word));
  }

private:
  AddressMask words_ = 0;
};

} // namespace
NCVET_RULE(ContourCornerSingleBlock, contour_corner_single_block)
} // namespace ncvet
