// An arc under scale factors that differ.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ArcInDistortedFrame final : public Rule {
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
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Code) {
      const CodeInfo &code = ctx.code(event);
      distorted_ = {};
      if (llvm::StringRef(code.name).endswith("SCALE") && unequal(ctx))
        distorted_ = ctx.range(*event.word);
      return;
    }
    if (event.code != noCode && hasNotice(ctx.code(event)))
      underModalCode(event, ctx);
    if (!distorted_.end || event.code == noCode || event.motion == MotionKind::Feed ||
        distorted_.file != ctx.source().id() || ctx.block().begin < distorted_.begin)
      return;
    if (auto finding = ctx.report(event))
      finding
          .message(
              "`{0}` under scale factors that differ in the plane: the control makes no ellipse",
              ctx.code(event).name)
          .note(distorted_, "the factors are programmed here");
  }
  void remember(RuleMemory &memory) const override { memory(distorted_); }

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

  /// The two axes of the plane have different factors; an axis that is not named has 1.
  static bool unequal(RuleContext &ctx) {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.before());
    double factor[2] = {1, 1};
    unsigned i = 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      if (!(plane >> axis & 1))
        continue;
      if (const Word *word = ctx.block().find(AddressId(letterAddress('X') + axis))) {
        const Interval value = ctx.value(*word);
        if (!value.isConstant())
          return false;
        factor[i] = value.value();
      }
      ++i;
    }
    return factor[0] != factor[1];
  }

  SourceRange distorted_;
  bool lines_ = false; ///< the tables speak of straight lines as well
};

} // namespace
NCVET_RULE(ArcInDistortedFrame, arc_in_distorted_frame)
} // namespace ncvet
