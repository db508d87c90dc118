// A corner mode that does not suit the work.
#include "analyzer/rule/rule.h"

#include <cmath>

namespace ncvet {
namespace {

class ModalPathModeAdvice final : public Rule {
public:
  /// The tables say most of it; what they say is reported for it.
  void listen(Subscriptions &to) override {
    moves_ = unsigned(to.option("shortMoves", 0));
    length_ = to.option("shortLength", 1);
    if (moves_ && to.dialect().group(StandardGroup::PathMode) != noGroup)
      to.onMoves({MotionKind::Feed, MotionKind::Rapid});
  }

  /// Many short moves in a row, each of which stops at its end.
  void on(const Event &event, RuleContext &ctx) override {
    const bool goesOn = ctx.block().begin == behind_;
    behind_ = ctx.block().next;
    if (event.motion != MotionKind::Feed || event.code == noCode || !isShort(event, ctx)) {
      inARow_ = 0;
      return;
    }
    inARow_ = goesOn ? inARow_ + 1 : 1;
    const GroupIndex index = ctx.dialect().group(StandardGroup::PathMode);
    const GroupInfo &group = ctx.dialect().groups[index];
    if (inARow_ != moves_ || said_ || group.initial == 0xFF ||
        ctx.after().group(index) != (uint64_t(1) << group.initial))
      return;
    said_ = true;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("{0} short moves in a row under `{1}`: it stops at their corners", inARow_,
                      ctx.dialect().codes[group.members[group.initial]].name);
  }
  void remember(RuleMemory &memory) const override { memory(length_, inARow_, behind_, said_); }

private:
  bool isShort(const Event &event, const RuleContext &ctx) const {
    double square = 0;
    for (unsigned i = 0; i < axisCount; ++i) {
      if (!(event.axes >> i & 1))
        continue;
      const Interval &from = ctx.before().position[i], &to = ctx.after().position[i];
      if (!from.isConstant() || !to.isConstant())
        return false;
      square += (to.value() - from.value()) * (to.value() - from.value());
    }
    return square > 0 && std::sqrt(square) < length_;
  }

  unsigned moves_ = 0; ///< that are many; 0: not looked at
  double length_ = 1;  ///< of a short one, in millimetres
  unsigned inARow_ = 0;
  uint32_t behind_ = ~0u; ///< behind the last block that moved
  bool said_ = false;
};

} // namespace
NCVET_RULE(ModalPathModeAdvice, modal_path_mode_advice)
} // namespace ncvet
