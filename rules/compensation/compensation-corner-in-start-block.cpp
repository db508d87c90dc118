// A chamfer or rounding in the move that switches compensation on or off.
#include "analyzer/facts/corner_words.h"

namespace ncvet {
namespace {

class CompensationCornerInStartBlock final : public Rule {
public:
  void listen(Subscriptions &to) override {
    const CornerAddresses corners = cornerAddresses(to.dialect());
    plain_ = corners.plain;
    // Of controls that write corners by addresses of their own nothing of the kind is known.
    words_ = corners.corner() & (corners.plain | maskOf(commaC) | maskOf(commaR));
    if (words_)
      to.onChange({EventKind::CompensationMove});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Word *word = ctx.block().findAny(words_);
    if (!word || !event.certain || event.code == noCode ||
        ctx.before().profile == ProfileMode::Recorded || takenByOther(ctx, plain_))
      return;
    // In an arc's block the plain letters are its own, and a corner in a rapid is another matter.
    if (llvm::none_of(ctx.outcome().events, [](const Event &each) {
          return each.kind == EventKind::Motion && each.motion == MotionKind::Feed;
        }))
      return;
    const bool off = ctx.code(event).action == Action::CompensationOff;
    if (auto finding = ctx.report(*word, !ctx.before().may(Fact::UnknownCode)))
      finding.message("`{0}` asks for a corner in the move that {1} compensation: the control "
                      "cannot compute it there",
                      ctx.text(*word), off ? "removes" : "builds up");
  }

private:
  AddressMask words_ = 0;
  AddressMask plain_ = 0; ///< of these: letters that mean something else in other blocks
};

} // namespace
NCVET_RULE(CompensationCornerInStartBlock, compensation_corner_in_start_block)
} // namespace ncvet
