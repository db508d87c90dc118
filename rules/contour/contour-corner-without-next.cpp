// A chamfer or rounding has no following move.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/corner_words.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
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
    Block next;
    bool more = ahead.nextAtWork(next);
    for (unsigned i = 0; more; ++i, more = ahead.nextAtWork(next)) {
      if (!next.items.empty() || next.skip >= 0)
        return;
      const uint16_t then = axesOf(ctx, next);
      const bool leaves =
          (plane_ || i > 0 || !plain) && then && !(then & planeAxes(ctx.dialect(), ctx.after()));
      if ((then && !leaves) ||
          next.hasAny(corners_.angle | ctx.dialect().elementWords | lettersMask("IJ")))
        return;
      if (leaves && (plane_ ? i + 1 >= blocksBetweenMoves : i > 0))
        break;
      if (i + 1 >= (plain ? between_ : blocksBetweenMoves) ||
          findCode(ctx.dialect(), next,
                   {Action::ProgramEnd, Action::ProgramEndRewind, Action::ProgramStop,
                    Action::ToolChange}))
        break;
    }
    if (!more && !ahead.isOver())
      return;
    if (auto finding = ctx.report(*word)) {
      finding.message("`{0}` asks for a corner, and no move follows with which it could be made",
                      ctx.text(*word));
      if (more)
        finding.note(ahead.range(next), "the next block");
    }
  }

private:
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
