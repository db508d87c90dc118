// The end of a line does not lie in the direction of its angle.
#include "analyzer/facts/corner_words.h"
#include "analyzer/facts/length_text.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/geometry/line.h"

namespace ncvet {
namespace {

class ContourAngleDirection final : public Rule {
public:
  void listen(Subscriptions &to) override {
    corners_ = cornerAddresses(to.dialect());
    if (corners_.angle)
      to.onChange({EventKind::Motion});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (!event.certain || event.code == noCode || event.inMachineCoordinates() ||
        ctx.before().profile == ProfileMode::Recorded || ctx.before().may(Fact::UnknownCode))
      return;
    if (isArc(event.motion))
      circleAndLine(event, ctx);
    else if (event.motion == MotionKind::Feed && ctx.code(event).action == Action::Linear)
      line(ctx);
    else
      sleepInShape();
  }

private:
  void line(RuleContext &ctx) const {
    const Word *word = ctx.block().findAny(corners_.angle);
    if (!word)
      return sleepInShape();
    if (takenByOther(ctx, corners_.angle & corners_.plain))
      return;
    const Interval angle = ctx.value(*word);
    if (!angle.isConstant())
      return;
    const Dialect &dialect = ctx.dialect();
    const std::array<Axis, 2> axes = planeOrder(dialect, ctx.after());
    const Vector direction = unitVector(radiansOf(angle.value()));
    Vector way = Vector::Zero();
    unsigned given = 0, which = 0;
    for (unsigned i = 0; i < 2; ++i) {
      if (!(axesOf(dialect, ctx.block()) >> unsigned(axes[i]) & 1))
        continue;
      const auto from = placeInPlane(dialect, ctx.before(), axes[i]);
      const Interval &to = ctx.outcome().via[size_t(axes[i])];
      if (!from || !to.isConstant())
        return;
      way[i] = to.value() / dialect.lengthsPerUnit(axes[i]) - *from;
      which = i;
      ++given;
    }
    if (given == 2)
      misses(*word, direction, way, ctx);
    else if (given == 1)
      opposite(*word, axes[which], direction[which], way[which], ctx);
  }

  /// By one coordinate: the path to it points against the angle.
  void opposite(const Word &word, Axis axis, double component, double way, RuleContext &ctx) const {
    // Where the next element ends such a line the coordinate is not its end.
    if (dialectEndsByNext(ctx) || (word.address == commaA && ctx.after().compensation != phaseOff))
      return;
    if (std::fabs(component) < parallel || std::fabs(way) < shortest || component * way > 0)
      return;
    if (auto finding = ctx.report(word))
      finding.message("`{0}` points towards {1}{2}, and the end of this line lies towards {3}{2}",
                      ctx.text(word), component > 0 ? "+" : "-",
                      axis == Axis::X   ? "X"
                      : axis == Axis::Y ? "Y"
                                        : "Z",
                      way > 0 ? "+" : "-");
  }

  static bool dialectEndsByNext(const RuleContext &ctx) {
    return ctx.dialect().lineAngleWords != 0;
  }

  /// By both coordinates: the line at this angle through the end does not lead through the start.
  void misses(const Word &word, const Vector &direction, const Vector &way,
              RuleContext &ctx) const {
    // The end of an arc may be what this line decides.
    if (!dialectEndsByNext(ctx) || isArcActive(ctx.before(), ctx.dialect()) ||
        ctx.block().hasAny(ctx.dialect().elementWords) ||
        ctx.outcome().kinds & bitOf(EventKind::CompensationMove)) // on its way to the contour
      return;
    const double aside = std::fabs(cross(direction, way));
    if (aside < leastAside || aside < leastSine * way.norm())
      return;
    if (auto finding = ctx.report(word))
      finding.message("the line at `{0}` through its end passes {1} beside its start",
                      ctx.text(word), lengthText(ctx, aside));
  }

  static bool isArcActive(const MachineState &state, const Dialect &dialect) {
    const CodeInfo *motion = state.activeCode(dialect, StandardGroup::Motion);
    return !motion || isArc(motion->action);
  }

  /// A circle, and a line whose end and angle are given: it begins at one of the two points in
  /// which it meets the circle, and runs from there to its end.
  void circleAndLine(const Event &event, RuleContext &ctx) const {
    if (!(corners_.angle & maskOf(commaA)) || ctx.after().compensation == phaseOff)
      return sleepInShape();
    if (!angleFollows(ctx))
      return;
    const bool clockwise = event.motion == MotionKind::ArcCw;
    const Dialect &dialect = ctx.dialect();
    const ArcWords &words = ctx.arcWords();
    const ArcGeometry &arc = ctx.arc();
    if (!arc.start || !arc.end)
      return;
    PathAhead ahead(ctx);
    if (!ahead.next())
      return;
    const Word *angleWord = ahead.block().find(commaA), *selector = ahead.block().find('Q');
    const CodeInfo *motion = ahead.executed().after.activeCode(dialect, StandardGroup::Motion);
    const uint16_t plane = planeAxes(dialect, ctx.after());
    if (!angleWord || !selector || !motion || motion->action != Action::Linear ||
        (axesOf(ctx, ahead.block()) & plane) != plane)
      return;
    const Interval angle = wordValue(*angleWord, ahead.block(), ahead.executed().before);
    const Interval chosen = wordValue(*selector, ahead.block(), ahead.executed().before);
    const auto centre = words.hasCentre() ? arc.centre()
                        : arc.radius ? centreByRadius(*arc.start, *arc.end, *arc.radius, clockwise)
                                     : std::nullopt;
    if (!angle.isConstant() || !chosen.isConstant() || chosen.value() == 0 || !centre)
      return;
    Point target = Point::Zero();
    for (size_t i = 0; i < 2; ++i) {
      const Interval &to = ahead.outcome().via[size_t(words.axes[i])];
      if (!to.isConstant())
        return;
      target[i] = to.value() / dialect.lengthsPerUnit(words.axes[i]);
    }
    const Vector direction = unitVector(radiansOf(angle.value()));
    const double radius = distance(*centre, *arc.start);
    const Point foot = footOnLine(target, direction, *centre);
    const double away = distance(foot, *centre);
    if (away >= radius)
      return;
    const double half = std::sqrt(radius * radius - away * away) * (chosen.value() < 0 ? -1 : 1);
    const Point taken = foot + direction * half, other = foot - direction * half;
    const SourceRange at{ahead.range().file, angleWord->offset, ahead.block().endOf(*angleWord)};
    const bool met = onArc(taken, *arc.start, *arc.end, *centre, clockwise);
    const char *message = nullptr;
    if (met && direction.dot(target - taken) < -shortest)
      message = "`{0}` points away from the end of this line: its angle is that of the path from "
                "the circle to that end";
    // The target is the point on the path that the circle's own words describe.
    else if (!met && onArc(other, *arc.start, *arc.end, *centre, clockwise) &&
             direction.dot(target - other) < 0)
      message = "`{0}` points from the end of this line back to the circle: the control leaves the "
                "circle at the other of the two points in which they meet";
    if (!message)
      return;
    if (auto finding = ctx.report(at))
      finding.severity(Severity::Warning)
          .message(message, ctx.text(at))
          .note(ctx.blockRange(), "the circle");
  }

  /// Whether a block soon after this one may have a word `,A`: its text is read, which costs far
  /// less than executing it.
  static bool angleFollows(const RuleContext &ctx) {
    if (const Block *alike = ctx.nextAlike(); alike && isOtherMove(*alike, ctx.dialect())) {
      ctx.index().noteRead(alike->begin, alike->next);
      return false;
    }
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < readAhead && ahead.next(next); ++i) {
      if (next.has(commaA))
        return true;
      if (isOtherMove(next, ctx.dialect()))
        return false;
    }
    return false;
  }
  static bool isOtherMove(const Block &block, const Dialect &dialect) {
    return !block.has(commaA) && block.hasAny(dialect.axisWords) &&
           (!block.has(letterAddress('G')) || hasMotionCode(dialect, block));
  }

  static bool onArc(const Point &point, const Point &start, const Point &end, const Point &centre,
                    bool clockwise) {
    const auto turned = [&](const Point &to) { // from the start, in full turns
      const double a = angleOf(start - centre), b = angleOf(to - centre);
      const double turns = (clockwise ? a - b : b - a) / fullTurn;
      return turns - std::floor(turns);
    };
    return turned(point) <= turned(end);
  }

  static constexpr double parallel = 1e-6;
  static constexpr double shortest = 1e-4;   // mm
  static constexpr double leastAside = 0.05; // mm: coordinates and angles are written rounded
  static constexpr double leastSine = 0.002; // a tenth of a degree
  /// Blocks that may lie between an arc and the line after it.
  static constexpr unsigned readAhead = 16;
  CornerAddresses corners_;
};

} // namespace
NCVET_RULE(ContourAngleDirection, contour_angle_direction)
} // namespace ncvet
