// An arc with an axis outside of its plane, on a control that does not say what becomes of it.
#include "analyzer/rule.h"

namespace ncvet {
namespace {

class ArcHelixAxis final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (to.option("wanted", 0) != 0)
      to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
  }

  void on(const Event &event, RuleContext &ctx) override {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    if (event.code == noCode || event.number || !event.certain || !(event.axes & ~plane) ||
        ctx.after().active(ctx.dialect(), StandardGroup::Plane) == groupUnset)
      return;
    for (const Word &word : ctx.block().words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if ((address.kind != AddressKind::Axis && address.kind != AddressKind::Increment) ||
          (plane >> unsigned(address.axis) & 1))
        continue;
      if (auto finding = ctx.report(word))
        finding.message("`{0}` lies outside of the plane of `{1}`: whether the axis moves along "
                        "with the arc is not stated",
                        ctx.text(word), ctx.code(event).name);
      return;
    }
  }
};

} // namespace
NCVET_RULE(ArcHelixAxis, arc_helix_axis)
} // namespace ncvet
