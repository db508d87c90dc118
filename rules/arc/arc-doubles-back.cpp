// An arc that turns back on itself at both ends: the other direction of turning was meant.
#include "analyzer/facts/direction_before.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/geometry/circle.h"

#include <cmath>

namespace ncvet {
namespace {

class ArcDoublesBack final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    cosine_ = unitVector(radiansOf(to.number("turn", 150))).x();
  }

  void on(const Event &event, RuleContext &ctx) const override {
    // In a chain of arcs under one code none is turned otherwise than its neighbours.
    const ArcWords &words = ctx.arcWords();
    if (event.code == noCode || !event.certain || !ctx.codeWord(event) || !words.hasCentre() ||
        words.foreign || words.angle)
      return sleepInShape();
    if (!isHalfATurnOrMore(event, ctx) || ctx.before().may(Fact::UnknownCode) ||
        goesOnAhead(directionAtEnd(event, ctx.arc()), ctx))
      return;
    const auto arc = contourElementOf(executedBlock(ctx));
    if (!arc)
      return;
    const Vector begin = arc->direction(arc->from), end = arc->direction(arc->to);
    PathAhead ahead(ctx);
    if (!ahead.next())
      return;
    const auto after = directionAt(ahead.executed(), false);
    if (!after || end.dot(*after) > cosine_)
      return;
    const auto before = directionBefore(ctx);
    if (!before || before->dot(begin) > cosine_)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("`{0}` turns back at both ends of this arc: the path runs into it and out of it "
                   "the other way round",
                   ctx.code(event).name)
          .note(ahead.range(), "the next element");
  }

private:
  /// Whether the arc makes more than half a turn, as one of less does when it is turned the other
  /// way round, or half a turn after a line. Neighbours of others are not read: it costs time, and
  /// of half turns in a chain none is turned otherwise than its neighbours.
  static bool isHalfATurnOrMore(const Event &event, RuleContext &ctx) {
    const ArcGeometry &arc = ctx.arc();
    const auto centre = arc.centre();
    if (!arc.start || !arc.end || !centre || arc.radius)
      return false;
    const Vector from = *arc.start - *centre, to = *arc.end - *centre;
    const double sine = cross(from, to) * (event.motion == MotionKind::ArcCw ? -1 : 1);
    // Sine of what is less than half a turn for certain, and of what is less than a whole one.
    constexpr double little = 0.02;
    const double scale = from.norm() * to.norm();
    const bool half = std::fabs(sine) <= little * scale && from.dot(to) < 0;
    const bool afterLine =
        ctx.before().activeAction(ctx.dialect(), StandardGroup::Motion) == Action::Linear;
    return half ? afterLine : sine < -little * scale;
  }

  static Vector directionAtEnd(const Event &event, const ArcGeometry &arc) {
    return leftOf(*arc.end - *arc.centre()).normalized() *
           (event.motion == MotionKind::ArcCw ? -1 : 1);
  }

  /// Whether the next block is a line or an arc that goes on from the arc without turning back: its
  /// text is read, which costs far less than executing it. False also where the text does not say
  /// it.
  bool goesOnAhead(const Vector &end, const RuleContext &ctx) const {
    const Dialect &dialect = ctx.dialect();
    const MachineState &state = ctx.after();
    const Block *const next = ctx.nextAlike();
    const auto unit = millimetresPer(dialect, state);
    const std::array<Axis, 2> axes = ctx.arcWords().axes;
    const Interval &x = state.at(axes[0]), &y = state.at(axes[1]);
    if (!next || !unit || dialect.isLathe() || !state.frames.empty() || next->skip >= 0 ||
        (dialect.group(StandardGroup::Diameter) != noGroup && axes[0] == Axis::Z) ||
        state.isActive(dialect, StandardGroup::Distance, {Action::Absolute}) != Truth::Yes ||
        !x.isConstant() || !y.isConstant())
      return false;
    const auto direction = beginOf(*next, {x.value(), y.value()}, *unit, ctx);
    if (!direction || end.dot(*direction) <= cosine_)
      return false;
    ctx.index().noteRead(next->begin, next->next);
    return true;
  }

  /// Direction in which a move begins by the words of its block, which names its code.
  static std::optional<Vector> beginOf(const Block &block, const Point &from, double unit,
                                       const RuleContext &ctx) {
    constexpr double shortest = 1e-3; // mm
    const ArcWords &here = ctx.arcWords();
    Point to = from, centre = from;
    std::optional<double> radius;
    Action action = Action::None;
    bool hasCentre = false;
    for (const Word &word : block.words) {
      const CodeIndex code = codeOf(ctx.dialect(), word);
      if (code != noCode && action == Action::None) {
        action = ctx.dialect().codes[code].action;
        continue;
      }
      if (word.address == letterAddress('F'))
        continue;
      if (!word.isNumber() || !word.has(wordPoint))
        return std::nullopt;
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      const double number = word.value() * unit;
      bool isKnown = word.address == ctx.dialect().arcRadius;
      if (isKnown)
        radius = number;
      for (unsigned i = 0; i < 2 && !isKnown; ++i) {
        isKnown = address.kind == AddressKind::Axis && address.axis == here.axes[i];
        if (isKnown)
          to[i] = number;
        else if ((isKnown = word.address == here.centreAddress[i]))
          centre[i] += number, hasCentre = true;
      }
      if (!isKnown)
        return std::nullopt;
    }
    if (action == Action::Linear)
      return radius || hasCentre || distance(from, to) < shortest
                 ? std::nullopt
                 : std::optional<Vector>((to - from).normalized());
    if (!isArc(action) || hasCentre == radius.has_value() || ctx.arc().centreAbsolute)
      return std::nullopt;
    const bool clockwise = action == Action::ArcCw;
    if (radius) {
      const auto found = centreByRadius(from, to, *radius, clockwise);
      if (!found)
        return std::nullopt;
      centre = *found;
    }
    if (distance(centre, from) < shortest)
      return std::nullopt;
    return Vector(leftOf(from - centre).normalized() * (clockwise ? -1 : 1));
  }

  double cosine_ = 0; ///< of the turn from which on the path doubles back
};

} // namespace
NCVET_RULE(ArcDoublesBack, arc_doubles_back)
} // namespace ncvet
