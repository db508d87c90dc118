// A frame that replaces the one in force.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {
namespace {

class CoordinateFrameReplaced final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::FrameSet});
    to.onCode([](const CodeInfo &code) { return counts(code); });
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const CodeInfo &code = ctx.code(event);
    if (code.action != Action::FrameSet)
      return again(event, code, ctx);
    if (code.effect.index >= maxSwitches || !code.effect.on ||
        !ctx.before().switchMustBeOn(code.effect.index) || ctx.before().may(Fact::UnknownCode))
      return;
    const Origin &origin = ctx.before().origin.ofSwitch(code.effect.index);
    // In a loop each pass begins its frames anew.
    if (isHere(ctx, origin) && origin.begin > event.word->offset)
      return;
    // The same frame with other values is meant to replace it.
    if (origin.known() && ctx.text(origin.range()).equals_insensitive(ctx.text(*event.word)) &&
        !isOfOtherAxis(origin, ctx))
      return;
    if (beganAlike(code, ctx) || isReset(code, ctx))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` deletes the frame that is in force: a frame on top of it is `A{0}`",
                   code.name)
          .note(origin, "that frame is programmed here");
  }

private:
  /// The frames in force began with the same code: the next place of a part begins anew, as
  /// `TRANS`, `AROT` and `TRANS` again. After `TRANS X40 Y30` and `ATRANS X75` a `TRANS X75` gives
  /// up Y, where a row of ATRANS goes on;
  /// after `TRANS X60 Y40` and `AROT` a `TRANS X45` alone gives up Y and the rotation.
  static bool beganAlike(const CodeInfo &code, const RuleContext &ctx) {
    constexpr unsigned furthest = 200; // blocks
    Block block;
    bool added = false, alikeLast = false, turnedLast = false;
    bool more = readPrevious(ctx, block);
    for (unsigned i = 0; more && i < furthest; ++i, more = readBack(ctx, block)) {
      const CodeInfo *const frame =
          findCode(ctx.dialect(), block, {Action::FrameSet, Action::FrameAdd, Action::FrameClear});
      if (frame && frame->action != Action::FrameAdd)
        return added && frame->name == code.name &&
               !((alikeLast || (turnedLast && !turnsNext(ctx))) && losesAxis(block, ctx));
      if (frame && !added) {
        alikeLast = frame->frame == code.frame &&
                    axesOf(ctx.dialect(), block) == axesOf(ctx.dialect(), ctx.block());
        turnedLast = frame->frame == FrameKind::Rotation && code.frame == FrameKind::Shift;
      }
      added |= frame != nullptr;
    }
    return false;
  }

  /// The next block adds a frame to this one, as the place before had it.
  static bool turnsNext(const RuleContext &ctx) {
    BlocksAhead ahead(ctx);
    Block next;
    return !ahead.next(next) || findCode(ctx.dialect(), next, {Action::FrameAdd});
  }

  /// The first frame moves an axis that this one does not name.
  static bool losesAxis(const Block &first, const RuleContext &ctx) {
    return llvm::any_of(first.words, [&](const Word &word) {
      const AddressMask mask = maskOf(word.address);
      return (mask & ctx.dialect().axisWords) && !ctx.block().hasAny(mask) && word.isNumber() &&
             word.mantissa != 0;
    });
  }

  /// `TRANS X0 Y0 Z0` takes the frame away, and says so.
  static bool isReset(const CodeInfo &code, const RuleContext &ctx) {
    const AddressMask axes = ctx.dialect().axisWords;
    return code.frame == FrameKind::Shift && ctx.block().hasAny(axes) &&
           llvm::all_of(ctx.block().words, [&](const Word &word) {
             return !(maskOf(word.address) & axes) || (word.isNumber() && word.mantissa == 0);
           });
  }

  /// The block before gives the same frame for another axis, and nothing has moved in it.
  static bool isOfOtherAxis(const Origin &origin, const RuleContext &ctx) {
    Block previous;
    if (!isHere(ctx, origin) || !readPrevious(ctx, previous) || previous.begin > origin.begin ||
        origin.begin >= previous.end)
      return false;
    const uint16_t first = axesOf(ctx.dialect(), previous),
                   here = axesOf(ctx.dialect(), ctx.block());
    return first && here && !(first & here);
  }

  /// A frame that a repetition sets once per pass.
  static bool counts(const CodeInfo &code) {
    return code.action == Action::FrameAdd && code.group != noGroup &&
           llvm::any_of(code.words, [](const WordSpec &w) { return w.role == Role::Repeat; });
  }

  /// The same code at another place, while its frame is on: no pass of a repetition.
  static void again(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    const MachineState &before = ctx.before();
    if (!counts(code) || code.effect.index >= maxSwitches ||
        !before.switchMustBeOn(code.effect.index) || before.may(Fact::UnknownCode) ||
        before.group(code.group) != (uint64_t(1) << code.bit))
      return;
    const Origin &origin = before.origin.ofGroup(code.group);
    if (!origin.known() || (origin.file == ctx.source().id() && origin.begin == event.word->offset))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` while the frame of another `{0}` is on: nothing has ended that one",
                   code.name)
          .note(origin, "that frame is programmed here");
  }
};

} // namespace
NCVET_RULE(CoordinateFrameReplaced, coordinate_frame_replaced)
} // namespace ncvet
