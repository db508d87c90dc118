// An arc, or compensation, under scale factors that differ.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <cmath>

namespace ncvet {
namespace {

struct ArcInDistortedFrameMemory {
  SourceRange factors; ///< the last ones, for the note
};

class ArcInDistortedFrame final : public StatefulRule<ArcInDistortedFrameMemory> {
public:
  void listen(Subscriptions &to) override {
    lines_ = llvm::any_of(to.dialect().codes, [](const CodeInfo &code) {
      return code.action == Action::Linear && hasNotice(code);
    });
    if (lines_)
      to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw, MotionKind::Feed});
    else
      to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    to.onAction({Action::FrameSet, Action::FrameAdd, Action::FrameClear});
    scales_ = llvm::any_of(to.dialect().codes, isScale);
    if (scales_)
      to.onAction({Action::CompensationLeft, Action::CompensationRight});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code) {
      const CodeInfo &code = ctx.code(event);
      if (code.action == Action::CompensationLeft || code.action == Action::CompensationRight)
        return compensation(event, ctx);
      if (isScale(code))
        memory().factors = ctx.range(*event.word);
      else if (code.action != Action::FrameAdd)
        memory().factors = {};
      return;
    }
    const bool noticed = event.code != noCode && hasNotice(ctx.code(event));
    if (!scales_ && !noticed)
      return sleepInShape();
    if (noticed)
      underModalCode(event, ctx);
    if (!scales_ || event.code == noCode || event.motion == MotionKind::Feed || !isDistorted(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message(
              "`{0}` under scale factors that differ in the plane: the control makes no ellipse",
              ctx.code(event).name)
          .note(memory().factors, "the factors are programmed here");
  }

private:
  static constexpr llvm::StringLiteral id{"arc-in-distorted-frame"};

  static bool hasNotice(const CodeInfo &code) {
    return llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
  }

  /// What the tables say of a motion code holds in the later blocks that it moves, too.
  static void underModalCode(const Event &event, RuleContext &ctx) {
    if (llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
          return ctx.code(use).base == ctx.code(event).base;
        }))
      return;
    Event shown = event;
    shown.word = ctx.block().findAny(ctx.dialect().axisWords);
    if (shown.word)
      ctx.reportNotices(id, shown);
  }

  static bool isScale(const CodeInfo &code) { return llvm::StringRef(code.name).endswith("SCALE"); }

  /// The path beside the contour would have another distance in each direction.
  void compensation(const Event &event, RuleContext &ctx) const {
    if (!isDistorted(ctx))
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` under scale factors that differ in the plane: the control makes no path "
                   "beside the contour",
                   ctx.code(event).name)
          .note(memory().factors, "the factors are programmed here");
  }

  /// Whether the frames in force stretch the two axes of the plane differently. They may have been
  /// programmed in a caller, or in a program that was called.
  static bool isDistorted(RuleContext &ctx) {
    const std::optional<Frame> frame = ctx.after().frames.total();
    if (!frame)
      return false;
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    double factor[2] = {1, 1};
    unsigned i = 0;
    for (unsigned axis = 0; axis < 3 && i < 2; ++axis)
      if (plane >> axis & 1)
        factor[i++] = frame->stretchOf(axis);
    return std::fabs(factor[0] - factor[1]) > 1e-6;
  }

  bool scales_ = false; ///< the control has codes that scale
  bool lines_ = false;  ///< the tables speak of straight lines as well
};

} // namespace
NCVET_RULE(ArcInDistortedFrame, arc_in_distorted_frame)
} // namespace ncvet
