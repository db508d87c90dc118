// A corner mode that does not suit the work.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

#include <cmath>

namespace ncvet {
namespace {

struct ModalPathModeAdviceMemory {
  unsigned inARow = 0;
  uint32_t next = ~0u; ///< after the last block that moved
  bool said = false;
};

class ModalPathModeAdvice final : public StatefulRule<ModalPathModeAdviceMemory> {
public:
  /// The tables say most of it; what they say is reported for it.
  void listen(Subscriptions &to) override {
    moves_ = to.dialect().facts->feed.shortMoves;
    length_ = to.dialect().facts->feed.shortMoveLength;
    best_ = to.dialect().find(to.dialect().facts->feed.smoothing);
    if (best_ != noCode && to.dialect().codes[best_].group == noGroup)
      best_ = noCode;
    if (moves_ && to.dialect().group(StandardGroup::PathMode) != noGroup)
      to.onMoves({MotionKind::Feed, MotionKind::Rapid});
  }

  /// Many short moves in a row, each of which stops at its end.
  void on(const Event &event, RuleContext &ctx) const override {
    const bool goesOn = ctx.block().begin == memory().next;
    memory().next = ctx.block().next;
    if (event.motion != MotionKind::Feed || event.code == noCode || !isShort(event, ctx)) {
      memory().inARow = 0;
      return;
    }
    memory().inARow = goesOn ? memory().inARow + 1 : 1;
    if (memory().inARow == moves_ && smoothedWorse(ctx))
      return;
    const GroupIndex index = ctx.dialect().group(StandardGroup::PathMode);
    const GroupInfo &group = ctx.dialect().groups[index];
    if (memory().inARow != moves_ || memory().said || group.initial == 0xFF ||
        ctx.after().group(index) != (uint64_t(1) << group.initial))
      return;
    memory().said = true;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("{0} short moves in a row under `{1}`: it stops at their corners",
                      memory().inARow, ctx.dialect().codes[group.members[group.initial]].name);
  }

private:
  /// Another code than the best one smooths these moves.
  bool smoothedWorse(RuleContext &ctx) const {
    if (best_ == noCode)
      return false;
    const CodeInfo &best = ctx.dialect().codes[best_];
    const GroupInfo &group = ctx.dialect().groups[best.group];
    const uint64_t now = ctx.after().group(best.group);
    const Origin &origin = ctx.after().origin.ofGroup(best.group);
    if (now & (groupUnset | (uint64_t(1) << best.bit) | (uint64_t(1) << group.initial)) ||
        now & (now - 1) || !origin.known() || memory().said)
      return false;
    memory().said = true;
    if (auto finding = ctx.report(origin.range()))
      finding.severity(Severity::Style)
          .message("short moves are smoothed by `{0}` here: `{1}` does it better",
                   ctx.text(origin.range()), best.name);
    return true;
  }

  CodeIndex best_ = noCode; ///< that smooths
  double length_ = 1;       ///< of a short one, in millimetres

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
};

} // namespace
NCVET_RULE(ModalPathModeAdvice, modal_path_mode_advice)
} // namespace ncvet
