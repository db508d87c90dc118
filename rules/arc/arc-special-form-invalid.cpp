// An arc through three points that lie on a line, or a tangential one that nothing leads to.
#include "analyzer/facts/lookahead.h"
#include "interp/geometry/line.h"

#include <array>
#include <cmath>

namespace ncvet {
namespace {

class ArcSpecialFormInvalid final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onAction({Action::CurveThrough, Action::CurveTangent});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    // The code alone moves nothing.
    if (!(ctx.outcome().kinds & bitOf(EventKind::Motion)) ||
        ctx.block().hasAny(ctx.dialect().polarWords))
      return;
    if (ctx.code(event).action == Action::CurveTangent)
      tangential(event, ctx);
    else
      threePoints(event, ctx);
  }

private:
  struct ThreePoints {
    SpacePoint start = SpacePoint::Zero(), middle = SpacePoint::Zero(), end = SpacePoint::Zero();
  };

  static void threePoints(const Event &event, RuleContext &ctx) {
    if (lacksPoint(event, ctx) || lacksCoordinate(event, ctx))
      return;
    const std::optional<ThreePoints> points = pointsOf(ctx);
    const std::optional<double> place = points ? partOfLine(*points) : std::nullopt;
    if (!place)
      return;
    auto finding = ctx.report(event, !ctx.before().may(Fact::UnknownCode));
    if (!finding)
      return;
    if (*place > 0 && *place < 1)
      finding.severity(Severity::Warning)
          .message("the intermediate point of `{0}` lies on the line from start to end: the "
                   "control drives that line, no arc",
                   ctx.code(event).name);
    else
      finding.message("the three points of `{0}` lie on a line, and the intermediate one not "
                      "between the others: no arc leads through them",
                      ctx.code(event).name);
  }

  /// Start, intermediate point and end; none when one is not known. An axis that nothing of the
  /// block moves may be unknown.
  static std::optional<ThreePoints> pointsOf(const RuleContext &ctx) {
    ThreePoints points;
    bool any = false;
    for (unsigned i = 0; i < 3; ++i) {
      const Interval &from = ctx.before().at(Axis(i)), &to = ctx.after().at(Axis(i));
      const Word *word = intermediate(i, ctx);
      const bool moves = axesOf(ctx.dialect(), ctx.block()) >> i & 1;
      if (!word && !moves)
        continue;
      // With one coordinate of the intermediate point left out it is not known which point is
      // meant.
      if (!word || !from.isConstant() || !to.isConstant() ||
          ctx.before().inMachineCoordinates(Axis(i)) || ctx.after().inMachineCoordinates(Axis(i)))
        return std::nullopt;
      const Interval given =
          lengthOf(*word, ctx.block(), ctx.dialect(), ctx.machine(), ctx.after());
      const Truth incremental =
          word->reading() == WordReading::Incremental ? Truth::Yes
          : word->reading() != WordReading::Modal
              ? Truth::No
              : ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental});
      if (!given.isConstant() || incremental == Truth::Unknown)
        return std::nullopt;
      points.start[i] = from.value();
      points.end[i] = to.value();
      points.middle[i] = given.value() + (incremental == Truth::Yes ? from.value() : 0);
      any = true;
    }
    return any ? std::optional(points) : std::nullopt;
  }

  /// Where the intermediate point lies on the line from start (0) to end (1); none when it lies
  /// beside that line, or when the arc ends where it begins, which is another matter.
  static std::optional<double> partOfLine(const ThreePoints &points) {
    const auto &[start, middle, end] = points;
    if ((end - start).norm() < tolerance)
      return std::nullopt;
    const PlaceOnLine place = placeOnLine(start, end, middle);
    return place.aside > tolerance ? std::nullopt : std::optional(place.along);
  }

  /// No coordinate of the intermediate point is given.
  static bool lacksPoint(const Event &event, RuleContext &ctx) {
    for (unsigned axis = 0; axis < 3; ++axis)
      if (intermediate(axis, ctx))
        return false;
    if (auto finding = ctx.report(event))
      finding.message("`{0}` has no intermediate point: the control does not know the arc",
                      ctx.code(event).name);
    return true;
  }

  /// Of the intermediate point one coordinate in the plane is given, and not the other.
  static bool lacksCoordinate(const Event &event, RuleContext &ctx) {
    const std::array<Axis, 2> plane = planeOrder(ctx.dialect(), ctx.after());
    const Word *first = intermediate(unsigned(plane[0]), ctx);
    const Word *second = intermediate(unsigned(plane[1]), ctx);
    const uint16_t axes = axesOf(ctx.dialect(), ctx.block());
    const Axis left = first ? plane[1] : plane[0];
    if (!first == !second || !(axes >> unsigned(left) & 1))
      return false;
    if (auto finding = ctx.report(event))
      finding.message(
          "the intermediate point of `{0}` has `{1}` alone: the other coordinate in the "
          "plane is missing",
          ctx.code(event).name, ctx.text(first ? *first : *second));
    return true;
  }

  /// I1 for X, J1 for Y, K1 for Z, as the format of the block's code names them.
  static const Word *intermediate(unsigned axis, const RuleContext &ctx) {
    for (const CodeUse &use : ctx.codes())
      if (ctx.code(use).action == Action::CurveThrough)
        for (const WordSpec &spec : ctx.code(use).words)
          if (spec.role == Role::Target)
            for (const Word &word : ctx.block().words)
              if (spec.any & maskOf(word.address) &&
                  unsigned(ctx.dialect().addressName(word.address).front() - 'I') == axis)
                return &word;
    return nullptr;
  }

  /// The direction in which it begins is that of the path before.
  static void tangential(const Event &event, RuleContext &ctx) {
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.before());
    bool none = !ctx.before().may(Fact::Moved);
    Block previous;
    if (!none && !ctx.block().hasLabel() && readPrevious(ctx, previous) && previous.items.empty() &&
        !previous.hasLabel() && !previous.hasAny(ctx.dialect().polarWords)) {
      const uint16_t axes = axesOf(ctx.dialect(), previous);
      const bool elsewhere =
          findCode(ctx.dialect(), previous,
                   {Action::FrameSet, Action::FrameAdd, Action::Pole, Action::Dwell, Action::Cycle,
                    Action::ReferenceReturn, Action::MachineMove});
      none = axes && !(axes & plane) && !elsewhere;
    }
    if (!none)
      return;
    if (auto finding = ctx.report(event, !ctx.before().may(Fact::UnknownCode)))
      finding.message("`{0}` continues the path before it, and the block before moves nothing in "
                      "the plane: there is no direction to begin with",
                      ctx.code(event).name);
  }

  static constexpr double tolerance = 0.001; // mm: the least that a program can write
};

} // namespace
NCVET_RULE(ArcSpecialFormInvalid, arc_special_form_invalid)
} // namespace ncvet
