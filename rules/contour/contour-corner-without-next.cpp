// A chamfer or rounding has no following move.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/corner_words.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/program/references.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/expression.h"
#include "interp/path/corner_path.h"

namespace ncvet {
namespace {

class ContourCornerWithoutNext final : public Rule {
public:
  void listen(Subscriptions &to) override {
    corners_ = cornerAddresses(to.dialect());
    plane_ = to.dialect().facts->corners.skipsMovesOutOfPlane;
    between_ = to.dialect().facts->corners.idleBlocksBetween ? blocksBetweenMoves : 1;
    if (corners_.corner())
      to.onChange({EventKind::Motion, EventKind::CycleRun});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun)
      return ctx.outcome().flow.kind == FlowKind::Profile ? lastOfProfile(event, ctx)
                                                          : sleepInShape();
    const Block &block = ctx.block();
    const Word *word = block.findAny(corners_.corner());
    if (!word)
      return sleepInShape();
    const bool plain = corners_.plain & maskOf(word->address);
    const bool arc = isArc(event.motion);
    if (!(event.motion == MotionKind::Feed || (arc && !plain)))
      return sleepInShape();
    if (ctx.before().profile != ProfileMode::Off || !event.certain || !asksForCorner(ctx, *word) ||
        takenByOther(ctx, corners_.plain))
      return;
    BlocksAhead ahead(ctx);
    Look look{*word, {}, true, true};
    if (follows(ahead, 0, look, ctx) != Follows::Nothing)
      return;
    if (auto finding = ctx.report(*word, look.certain)) {
      finding.message(look.certain
                          ? "`{0}` asks for a corner, and no move follows with which it could be "
                            "made"
                          : "`{0}` asks for a corner, and on one way from here no move follows "
                            "with which it could be made",
                      ctx.text(*word));
      if (look.certain && !look.next.words.empty())
        finding.note(ahead.range(look.next), "the next block");
    }
  }

private:
  enum class Follows : uint8_t { Move, Nothing, Untold };

  struct Look {
    const Word &corner;
    Block next;
    bool certain; ///< nothing decides at run time what comes
    bool forks;   ///< a condition may still lead two ways
  };

  /// Whether a move with which the corner can be made is among the next blocks.
  Follows follows(BlocksAhead &ahead, unsigned i, Look &look, RuleContext &ctx) const {
    const bool plain = corners_.plain & maskOf(look.corner.address);
    Block &next = look.next;
    bool more = ahead.nextAtWork(next);
    for (; more; ++i, more = ahead.nextAtWork(next)) {
      if (!next.items.empty())
        return eitherWay(ahead, i, look, ctx);
      const uint16_t then = axesOf(ctx, next);
      const bool leaves =
          (plane_ || i > 0 || !plain) && then && !(then & planeAxes(ctx.dialect(), ctx.after()));
      const bool joins =
          (then && !leaves) ||
          next.hasAny(corners_.angle | ctx.dialect().elementWords | lettersMask("IJ"));
      if (next.skip >= 0) {
        if (!joins)
          return Follows::Untold;
        look.certain = false; // without it the next one counts
        continue;
      }
      if (joins)
        return Follows::Move;
      if (leaves && (plane_ ? i + 1 >= blocksBetweenMoves : i > 0))
        break;
      if (i + 1 >= (plain ? between_ : blocksBetweenMoves) ||
          findCode(ctx.dialect(), next,
                   {Action::ProgramEnd, Action::ProgramEndRewind, Action::ProgramStop,
                    Action::ToolChange}))
        break;
    }
    if (!more)
      next = {};
    return more || ahead.isOver() ? Follows::Nothing : Follows::Untold;
  }

  static std::optional<uint32_t> targetOf(const Block &at, const Item &jump,
                                          const RuleContext &ctx) {
    const auto targets = at.argumentsOf(jump);
    if (targets.size() == 1)
      return blockNamed(ctx.index(), at, jump, targets[0]);
    const Value number =
        jump.value == noExpression ? Value() : evaluate(at, jump.value, ctx.after(), nullptr);
    return number.isConstant()
               ? resolveBlock(ctx.index(), ctx.index().programAt(at.begin),
                              Reference::toBlock(int64_t(number.number.value())), at.begin)
               : std::nullopt;
  }

  /// A jump under a condition of which nothing is known: both ways are looked at.
  Follows eitherWay(BlocksAhead &ahead, unsigned i, Look &look, RuleContext &ctx) const {
    const Block at = look.next;
    if (!std::exchange(look.forks, false) || &ahead.unit() != &ctx.unit() || !at.words.empty() ||
        at.skip >= 0 || at.items.size() != 2 || at.items[0].kind != ItemKind::If ||
        at.items[1].kind != ItemKind::Jump || at.items[0].condition == noExpression ||
        evaluate(at, at.items[0].condition, ctx.after(), nullptr).isConstant())
      return Follows::Untold;
    const auto to = targetOf(at, at.items[1], ctx);
    if (!to)
      return Follows::Untold;
    Block target;
    target.begin = target.next = *to;
    BlocksAhead through(ctx.unit(), at), jumped(ctx.unit(), target);
    look.certain = false;
    const Follows onWay = follows(through, i, look, ctx);
    if (onWay == Follows::Nothing)
      return onWay;
    const Follows afterJump = follows(jumped, i, look, ctx);
    return afterJump == Follows::Nothing || onWay == Follows::Untold ? afterJump : onWay;
  }

  /// The last block of a profile has no next element.
  void lastOfProfile(const Event &event, RuleContext &ctx) const {
    if (event.code == noCode)
      return;
    const Profile profile = readProfile(ctx);
    if (!profile.known)
      return;
    const ProfileBlock &last = profile.blocks.back();
    if (!last.moves || last.motion != MotionKind::Feed)
      return;
    const Word *word = last.block.findAny(corners_.corner());
    if (!word || (ctx.dialect().addresses[word->address].kind == AddressKind::Axis &&
                  !isCornerOfAxis(ctx.dialect(), last.block, ctx.after())))
      return;
    for (const CodeUse &use : last.codes)
      if (ctx.code(use).action == Action::CompensationOff)
        return;
    const SourceRange at{ctx.source().id(), word->offset, last.block.endOf(*word)};
    if (auto finding = ctx.report(at, event.certain))
      finding
          .message("`{0}` asks for a corner in the last block of the profile of `{1}`: nothing "
                   "follows there",
                   ctx.text(at), ctx.code(event).name)
          .note(ctx.blockRange(), "the cycle that works along this profile");
  }

  CornerAddresses corners_;
  unsigned between_ = 1; ///< blocks after a corner by a plain letter of which one has to move
  bool plane_ = false;   ///< a move out of the plane is passed over like a block without a move
};

} // namespace
NCVET_RULE(ContourCornerWithoutNext, contour_corner_without_next)
} // namespace ncvet
