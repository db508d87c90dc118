// Chamfer and rounding are in one block, have the wrong letter or the wrong sign.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/corner_words.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

#include <bit>
#include <cmath>

namespace ncvet {
namespace {

constexpr llvm::StringLiteral id = "contour-corner-words";

class ContourCornerWords final : public Rule {
public:
  void listen(Subscriptions &to) override {
    corners_ = cornerAddresses(to.dialect());
    senses_ = to.dialect().facts->corners.senseChecked;
    signed_ = to.dialect().facts->corners.plainRadiusSigned;
    nothing_ = to.dialect().facts->corners.commaOnly ? maskOf('R') : 0;
    to.onNotices(id);
    if (corners_.corner() | nothing_)
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      ctx.reportNotices(id, event);
      if (!asksNumbers(ctx.code(event), id))
        sleepInShape();
      return;
    }
    if (!senses_ && !isLine(ctx, event))
      return sleepInShape();
    const Block &block = ctx.block();
    if (block.hasAny(nothing_))
      withoutComma(event, ctx);
    if (!block.hasAny(corners_.corner() | nothing_))
      return sleepInShape();
    if (!block.hasAny(corners_.corner()))
      return;
    if (senses_)
      sense(ctx);
    if (!isLine(ctx, event) || takenByOther(ctx, corners_.plain))
      return;
    const Word *chamfer = block.findAny(corners_.chamfer);
    if (chamfer && !asksForCorner(ctx, *chamfer))
      chamfer = nullptr;
    const Word *rounding = block.findAny(corners_.rounding);
    if (chamfer && rounding) {
      const Word &second = chamfer->offset > rounding->offset ? *chamfer : *rounding;
      const Word &first = &second == chamfer ? *rounding : *chamfer;
      if (auto finding = ctx.report(second))
        finding.message(
            "`{0}` and `{1}` ask for two corners at one place: a block takes a chamfer or a "
            "rounding",
            ctx.text(first), ctx.text(second));
      return;
    }
    if (!chamfer && !rounding)
      return;
    const Word &word = chamfer ? *chamfer : *rounding;
    if (!(corners_.plain & maskOf(word.address)))
      return;
    constexpr uint16_t x = 1u << unsigned(Axis::X), z = 1u << unsigned(Axis::Z);
    if (!signed_ && !(maskOf(word.address) & lettersMask("IK")))
      return;
    const bool onlyX = (event.axes & (x | z)) == x, onlyZ = (event.axes & (x | z)) == z;
    const AddressId wrong = letterAddress(onlyX ? 'I' : 'K');
    if (const Word *other =
            onlyX || onlyZ ? block.findAny(maskOf(wrong) & corners_.plain) : nullptr) {
      if (auto finding = ctx.report(*other))
        finding.message("the chamfer of a move in {0} is written with {1}, not `{2}`",
                        onlyX ? "X" : "Z", onlyX ? "K" : "I", ctx.text(*other));
      return;
    }
    sign(event, word, onlyX, onlyZ, ctx);
  }

private:
  /// A plain R in the block of a line, where corners have a comma.
  void withoutComma(const Event &event, RuleContext &ctx) const {
    if (!isLine(ctx, event) || event.code == noCode || event.inMachineCoordinates() ||
        ctx.code(event).action != Action::Linear || takenByOther(ctx, nothing_) ||
        ctx.before().may(Fact::UnknownCode))
      return;
    const Word *word = ctx.block().findAny(nothing_);
    if (auto finding = ctx.report(*word))
      finding.message("a rounding is written `,R` on this control; `{0}` says nothing in a `{1}` "
                      "block",
                      ctx.text(*word), ctx.code(event).name);
  }

  /// A rounding whose sign is the side to which it turns: plus to the left.
  void sense(RuleContext &ctx) const {
    const Word *word = ctx.block().findAny(corners_.rounding & ~corners_.plain);
    const ExecutedBlock here = executedBlock(ctx);
    PathAhead ahead(ctx);
    if (!word || solved(ctx, ctx.block()) || !ahead.next() ||
        (solved(ctx, ahead.block()) && !isLineByAngle(ctx, ahead.block())))
      return;
    const auto in = directionAt(here, true), out = directionAt(ahead.executed(), false);
    const Interval size = ctx.value(*word);
    if (!in || !out || !size.isConstant() || size.value() == 0)
      return;
    const double turn = cross(*in, *out);
    constexpr double straight = 1e-3; // sine of the turn below which no side is told
    const bool left = size.value() > 0;
    if (std::fabs(turn) < straight || (turn > 0) == left)
      return;
    const bool lines = straightElement(here) && straightElement(ahead.executed());
    if (lines && left && !ctx.text(*word).contains('+'))
      return; // between two lines the sign may be left out
    if (auto finding = ctx.report(*word))
      finding.severity(Severity::Warning)
          .message("`{0}` turns to the {1}, but the contour turns to the {2} there",
                   ctx.text(*word), left ? "left" : "right", left ? "right" : "left");
  }

  /// The control finds the ends of such an element itself: its words are not where it meets the
  /// next one.
  bool solved(const RuleContext &ctx, const Block &block) const {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    return block.hasAny(corners_.angle | ctx.dialect().elementWords) ||
           !(axesOf(ctx, block) & plane);
  }

  /// A line by its angle and one coordinate: wherever it ends, its direction is known.
  bool isLineByAngle(const RuleContext &ctx, const Block &block) const {
    const unsigned given = axesOf(ctx, block) & planeAxes(ctx.dialect(), ctx.after());
    return block.hasAny(corners_.angle) && !block.hasAny(ctx.dialect().elementWords) &&
           std::has_single_bit(given);
  }

  /// The corner word carries the sign of the move that follows.
  void sign(const Event &event, const Word &word, bool onlyX, bool onlyZ, RuleContext &ctx) const {
    if (onlyX == onlyZ)
      return;
    const Axis axis = onlyX ? Axis::Z : Axis::X;
    const Interval size = ctx.value(word);
    BlocksAhead ahead(ctx);
    Block next;
    if (!size.isConstant() || size.value() == 0 || !ahead.next(next) || !next.items.empty() ||
        axesOf(ctx, next) != uint16_t(1u << unsigned(axis)))
      return;
    const Word *target = next.findAny(ctx.dialect().axisWords);
    if (!target || !target->isNumber())
      return;
    double way = target->value();
    if (ctx.dialect().addresses[target->address].kind != AddressKind::Increment) {
      const Interval &here = ctx.after().at(axis);
      const auto unit = millimetresPer(ctx.dialect(), ctx.after());
      if (!here.isConstant() || !unit || ctx.after().inMachineCoordinates(axis))
        return;
      way = way * *unit - here.value();
    }
    if (way == 0 || (way > 0) == (size.value() > 0))
      return;
    if (auto finding = ctx.report(word, event.certain))
      finding
          .message("`{0}` points towards {1}{2}, but the next move goes towards {3}{2}",
                   ctx.text(word), size.value() > 0 ? "+" : "-", axis == Axis::X ? "X" : "Z",
                   way > 0 ? "+" : "-")
          .note(ahead.range(next), "the next move");
  }

  CornerAddresses corners_;
  bool senses_ = false;     ///< the sign of a rounding is a side
  bool signed_ = true;      ///< a plain R carries the sign of the move that follows
  AddressMask nothing_ = 0; ///< letters that are no corners, though they look like them
};

} // namespace
NCVET_RULE(ContourCornerWords, contour_corner_words)
} // namespace ncvet
