// An arc fits only when the increment in X is read as a radius.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/geometry/circle.h"

#include <cmath>

namespace ncvet {
namespace {

/// Millimetres or inches by which the two radii of a good arc may differ.
constexpr double tolerance = 0.02;

class CoordinateDiameterConfusion final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onAction({Action::ArcCw, Action::ArcCcw}); }

  void on(const Event &event, RuleContext &ctx) const override {
    const Block &block = ctx.block();
    const Word *u = nullptr, *w = nullptr, *i = block.find('I'), *k = block.find('K');
    for (const Word &word : block.words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if (address.kind == AddressKind::Increment && address.axis == Axis::X && address.diameter)
        u = &word;
      else if (address.kind == AddressKind::Increment && address.axis == Axis::Z)
        w = &word;
      else if (address.kind == AddressKind::Axis)
        return sleepInShape();
    }
    if (!u || (!i && !k))
      return sleepInShape(); // one of the two may be left out where it is zero
    const Interval dx = ctx.value(*u), dz = w ? ctx.value(*w) : Interval::exactly(0),
                   ci = i ? ctx.value(*i) : Interval::exactly(0),
                   ck = k ? ctx.value(*k) : Interval::exactly(0);
    if (!dx.isConstant() || !dz.isConstant() || !ci.isConstant() || !ck.isConstant())
      return;
    const Point start = Point::Zero(), centre{ci.value(), ck.value()};
    const auto misfit = [&](double x) { return radiusDifference(centre, {x, dz.value()}, start); };
    const double asDiameter = misfit(dx.value() / 2);
    const bool asRadius = misfit(dx.value()) <= tolerance;
    const bool doubled = misfit(dx.value() / 4) <= tolerance;
    if (distance(centre, start) <= tolerance || asDiameter <= tolerance || !(asRadius || doubled))
      return;
    if (auto finding = ctx.report(*u))
      finding.message("`{0}` is a difference of diameters: the arc fits only if it is read as {1}",
                      ctx.text(*u), asRadius ? "a radius" : "twice a diameter");
    (void)event;
  }
};

} // namespace
NCVET_RULE(CoordinateDiameterConfusion, coordinate_diameter_confusion)
} // namespace ncvet
