// A chamfer or rounding that does not fit on its neighbours, or is not positive.
#include "analyzer/facts/corner_words.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class ContourCornerTooLarge final : public Rule {
public:
  void listen(Subscriptions &to) override {
    corners_ = cornerAddresses(to.dialect());
    words_ = corners_.corner();
    // A plain C is a chamfer where the line takes it and it is no axis.
    if (to.dialect().isLathe() &&
        to.dialect().addresses[letterAddress('C')].kind == AddressKind::Parameter)
      words_ |= maskOf('C');
    signed_ = to.dialect().facts->corners.signIsTurn;
    zero_ = to.dialect().facts->corners.zeroIsNone;
    tolerance_ = to.number("tolerance", 0.002);
    if (!words_)
      return;
    reader_.emplace(to.dialect());
    to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Word *word = ctx.block().findAny(words_);
    if (!word)
      return sleepInShape();
    const bool arc = isArc(event.motion);
    const bool plain = maskOf(word->address) & (corners_.plain | maskOf('C'));
    if (event.motion != MotionKind::Feed && !(arc && !plain))
      return sleepInShape();
    if (!event.certain || event.inMachineCoordinates() ||
        ctx.before().profile == ProfileMode::Recorded || ctx.before().may(Fact::UnknownCode) ||
        !asksForCorner(ctx, *word) || takenByOther(ctx, words_ & lettersMask("IJKRC")))
      return;
    if (!plain && notPositive(*word, ctx))
      return;
    fit(*word, ctx);
  }

private:
  bool notPositive(const Word &word, RuleContext &ctx) const {
    const AddressInfo &address = ctx.dialect().addresses[word.address];
    if (signed_ && address.rounding)
      return false;
    const Interval size = lengthOf(word, ctx.block(), ctx.dialect(), ctx.machine(), ctx.after());
    if (!(zero_ ? size.hi < 0 : size.hi <= 0))
      return false;
    if (size.hi < address.least) // its address does not take it
      return true;
    if (auto finding = ctx.report(word))
      finding.message("`{0}`: the size of a corner is above zero", ctx.text(word));
    return true;
  }

  /// The end of such a line is where it meets its neighbour, not the point of its words.
  bool meetsElsewhere(const Block &block, RuleContext &ctx) const {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    return (block.hasAny(corners_.angle) && (axesOf(ctx, block) & plane) == plane) ||
           block.hasAny(ctx.dialect().elementWords);
  }

  void fit(const Word &word, RuleContext &ctx) const {
    const auto in = straightElement(executedBlock(ctx));
    if (!in)
      return fitArc(word, ctx);
    const CornerRequest corner = reader_->read(executedBlock(ctx));
    PathAhead ahead(ctx);
    if (corner.kind == CornerRequest::Kind::None || meetsElsewhere(ctx.block(), ctx) ||
        !ahead.next() || meetsElsewhere(ahead.block(), ctx))
      return;
    const auto out = straightElement(ahead.executed());
    if (!out)
      return fitArc(word, ctx);
    const auto taken = out ? takenByCorner(corner, *in, *out) : std::nullopt;
    if (!taken)
      return;
    const SourceRange next = ahead.range();
    if (*taken > in->length() + tolerance_) {
      if (auto finding = ctx.report(word))
        finding.message("`{0}` takes {1} of this line, and it is {2} long", ctx.text(word),
                        lengthText(ctx, *taken), lengthText(ctx, in->length()));
      return;
    }
    if (*taken > out->length() + tolerance_) {
      if (auto finding = ctx.report(word))
        finding
            .message("`{0}` takes {1} of the next line, which is {2} long", ctx.text(word),
                     lengthText(ctx, *taken), lengthText(ctx, out->length()))
            .note(next, "the next line");
      return;
    }
    // A corner at either end of the next line.
    const CornerRequest second = reader_->read(ahead.executed());
    if (second.kind == CornerRequest::Kind::None || !ahead.next() ||
        meetsElsewhere(ahead.block(), ctx))
      return;
    const auto third = straightElement(ahead.executed());
    const auto further = third ? takenByCorner(second, *out, *third) : std::nullopt;
    if (!further || *further > out->length() + tolerance_ ||
        *taken + *further <= out->length() + tolerance_)
      return;
    if (auto finding = ctx.report(word))
      finding
          .message("`{0}` and the corner at its other end take {1} of the next line, "
                   "which is {2} long",
                   ctx.text(word), lengthText(ctx, *taken + *further),
                   lengthText(ctx, out->length()))
          .note(next, "the next line");
  }

  /// A rounding beside an arc.
  void fitArc(const Word &word, RuleContext &ctx) const {
    const auto in = contourElementOf(executedBlock(ctx));
    const CornerRequest corner = reader_->read(executedBlock(ctx));
    PathAhead ahead(ctx);
    if (!in || corner.kind != CornerRequest::Kind::Rounding || meetsElsewhere(ctx.block(), ctx) ||
        !ahead.next() || meetsElsewhere(ahead.block(), ctx))
      return;
    const auto out = contourElementOf(ahead.executed());
    const auto taken =
        out && (in->arc || out->arc) ? takenByRounding(corner.size, *in, *out) : std::nullopt;
    if (!taken)
      return;
    const bool here = (*taken)[0] > in->length() + tolerance_;
    if (!here && (*taken)[1] <= out->length() + tolerance_)
      return;
    if (auto finding = ctx.report(word))
      finding
          .message("`{0}` is too large: the rounding reaches past the {1} of {2}", ctx.text(word),
                   here ? "begin" : "end", here ? "this element" : "the next one")
          .note(ahead.range(), "the next element");
  }

  CornerAddresses corners_;
  AddressMask words_ = 0;
  std::optional<CornerWords> reader_;
  bool signed_ = false;      ///< the sign of a rounding is the sense of its turn
  bool zero_ = false;        ///< a size of zero leaves the corner as it is
  double tolerance_ = 0.002; // mm
};

} // namespace
NCVET_RULE(ContourCornerTooLarge, contour_corner_too_large)
} // namespace ncvet
