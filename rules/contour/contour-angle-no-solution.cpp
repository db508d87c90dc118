// The angle of a line runs parallel to the coordinate that is to be reached.
#include "analyzer/facts/corner_words.h"
#include "analyzer/rule/sleep_in_stretch.h"

#include <cmath>

namespace ncvet {
namespace {

class ContourAngleNoSolution final : public Rule {
public:
  void listen(Subscriptions &to) override {
    corners_ = cornerAddresses(to.dialect());
    if (corners_.angle)
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    const Word *word = ctx.block().findAny(corners_.angle);
    if (!word)
      return sleepInShape();
    if (!event.certain || takenByOther(ctx, corners_.angle & corners_.plain))
      return;
    const bool plain = corners_.plain & maskOf(word->address);
    if (event.motion != MotionKind::Feed && !(event.motion == MotionKind::Rapid && !plain))
      return;
    // The angle counts from the first axis of the plane.
    const auto order = planeOrder(ctx.dialect(), ctx.after());
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    const auto first = uint16_t(1u << unsigned(order[0]));
    const uint16_t given = event.axes & plane;
    const Interval angle = ctx.value(*word);
    if (!angle.isConstant() || (given != first && given != uint16_t(plane & ~first)))
      return;
    const double a = std::fabs(std::fmod(angle.value(), 180.0));
    const bool alongFirst = a < 1e-9 || a > 180 - 1e-9;
    const bool alongSecond = std::fabs(a - 90) < 1e-9;
    if (!(given == first ? alongSecond : alongFirst))
      return;
    const char axis = "XYZ"[unsigned(order[given != first])];
    if (auto finding = ctx.report(*word))
      finding.message(
          "a line at `{0}` never reaches the {1} coordinate of the block: it runs parallel to it",
          ctx.text(*word), axis);
  }

private:
  CornerAddresses corners_;
};

} // namespace
NCVET_RULE(ContourAngleNoSolution, contour_angle_no_solution)
} // namespace ncvet
