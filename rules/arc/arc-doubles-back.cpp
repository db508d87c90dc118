// An arc that turns back on itself at both ends: the other direction of turning was meant.
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/direction_before.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/text/number_text.h"
#include "interp/geometry/circle.h"
#include "interp/geometry/direction.h"

#include <cmath>
#include <map>

namespace ncvet {
namespace {

/// An arc that would join its neighbours smoothly with another radius, in units of the program.
struct OtherRadius {
  SourceRange range;
  double radius = 0;
};

struct ArcDoublesBackMemory {
  bool joins = false;     ///< an arc by its radius joins its neighbours smoothly
  bool turnsWork = false; ///< the last of `turned` was made on turned work
  SourceRange round{};    ///< the last arc that goes round once more about the same centre
  /// Those that would do so the other way round, by their places.
  std::map<TextPlace, SourceRange> turned;
  std::map<TextPlace, OtherRadius> other; ///< those that would do so with another radius
};

class ArcDoublesBack final : public StatefulRule<ArcDoublesBackMemory> {
public:
  void listen(Subscriptions &to) override {
    to.onMoves({MotionKind::ArcCw, MotionKind::ArcCcw});
    for (size_t i = 0; i < to.dialect().addresses.size(); ++i)
      if (to.dialect().addresses[i].kind == AddressKind::Axis)
        wordsOf_[unsigned(to.dialect().addresses[i].axis)] |= maskOf(AddressId(i));
    cosine_ = unitVector(radiansOf(to.number("turn", 150))).x();
  }

  /// One arc of all: what is done throughout is meant.
  void finish(const FileSummary &, RuleContext &ctx) const override {
    if (memory().joins && memory().other.size() == 1)
      tellRadius(memory().other.begin()->second, ctx);
    if (!(memory().joins || memory().turnsWork) || memory().turned.size() != 1)
      return;
    if (auto finding = ctx.report(memory().turned.begin()->second))
      finding.message("the arc makes a corner at both of its ends, and joins them smoothly when "
                      "it is turned the other way round{0}",
                      memory().joins ? ", as the others of the file are" : "");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (turnsBelowAxis(event, ctx))
      return;
    // In a chain of arcs under one code none is turned otherwise than its neighbours.
    const ArcWords &words = ctx.arcWords();
    if (event.code == noCode || !event.certain || !ctx.codeWord(event) || words.foreign ||
        words.angle || words.hasCentre() == (words.radius != nullptr))
      return sleepInShape();
    if (words.radius && words.radius->isNumber() && words.radius->value() < 0)
      return byNegativeRadius(event, ctx);
    if (words.radius)
      return byRadius(event, ctx);
    if (!ctx.block().hasAny(planeWords(ctx)))
      return amongCircles(event, ctx);
    if (!isHalfATurnOrMore(event, ctx) || ctx.before().may(Fact::UnknownCode) ||
        (isLong(event, ctx) && goesRoundAgain(event, ctx)) ||
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
    const bool turnsAtEnd = after && end.dot(*after) <= cosine_;
    if (!turnsAtEnd && !isLong(event, ctx))
      return;
    const auto before = directionBefore(ctx);
    const bool turnsAtBegin = before && before->dot(begin) <= cosine_;
    if (!(turnsAtEnd && turnsAtBegin)) {
      if (isLong(event, ctx) && ((turnsAtEnd && end.dot(*after) < -smooth) ||
                                 (turnsAtBegin && before->dot(begin) < -smooth)))
        atOneEnd(event, turnsAtEnd, ctx);
      return;
    }
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("`{0}` turns back at both ends of this arc: the path runs into it and out of it "
                   "the other way round",
                   ctx.code(event).name)
          .note(ahead.range(), "the next element");
  }

private:
  /// Where the work turns: from X0 or more to X0 or more, and in between far below the axis. Most
  /// arcs of turning have their centre further from the axis than that.
  static bool turnsBelowAxis(const Event &event, RuleContext &ctx) {
    constexpr double far = 0.5; // mm
    const auto &axes = ctx.arcWords().axes;
    const size_t x = axes[0] == Axis::X ? 0 : 1;
    if (axes[x] != Axis::X || axes[1 - x] != Axis::Z)
      return false;
    const ArcGeometry &arc = ctx.arc();
    if (!arc.start || !arc.end || !event.certain)
      return false;
    const bool clockwise = event.motion == MotionKind::ArcCw;
    const auto centre =
        arc.radius ? centreByRadius(*arc.start, *arc.end, *arc.radius, clockwise) : arc.centre();
    if (!centre)
      return false;
    const double radius = distance(*centre, *arc.end);
    if ((*centre)[x] - radius > -far || std::fabs(radius - distance(*centre, *arc.start)) > far ||
        (*arc.start)[x] < -1e-3 || (*arc.end)[x] < -1e-3 ||
        !turnsWork(ctx.dialect(), ctx.after()) || ctx.before().may(Fact::UnknownCode))
      return false;
    Point lowest = *centre;
    lowest[x] -= radius;
    // On the way round the lowest place comes before the end.
    const Vector from = *arc.start - *centre, to = *arc.end - *centre, low = lowest - *centre;
    const double sense = clockwise ? -1 : 1;
    const auto angle = [&](const Vector &at) {
      const double turned = sense * angleBetween(from, at);
      return turned < 0 ? turned + fullTurn : turned;
    };
    if (angle(low) >= angle(to))
      return false;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("`{0}` leads this arc {1} below the axis of the work: it is turned the other "
                      "way round",
                      ctx.code(event).name, shortNumber(radius - (*centre)[x]));
    return true;
  }

  /// Well over half a turn, and less than a whole one: the other way round it is a short arc.
  static bool isLong(const Event &event, const RuleContext &ctx) {
    constexpr double sineOfMore = 0.34; // of 200 degrees, without its sign
    const ArcGeometry &arc = ctx.arc();
    const auto centre = arc.centre();
    if (!arc.start || !arc.end || !centre)
      return false;
    const Vector from = *arc.start - *centre, to = *arc.end - *centre;
    const double sine = cross(from, to) * (event.motion == MotionKind::ArcCw ? -1 : 1);
    return sine < -sineOfMore * from.norm() * to.norm();
  }

  /// The next arc goes on about the same centre, and is as long: turned the other way round both
  /// are the quarters of one circle.
  bool goesRoundAgain(const Event &event, RuleContext &ctx) const {
    constexpr double tolerance = 1e-3; // mm
    const auto arc = contourElementOf(executedBlock(ctx));
    PathAhead ahead(ctx);
    if (!arc || !ahead.next())
      return false;
    const auto next = contourElementOf(ahead.executed());
    const auto stays = [](const ExecutedBlock &block) {
      return block.before.at(Axis::Z) == block.after.at(Axis::Z);
    };
    if (!next || !next->arc || next->clockwise != arc->clockwise ||
        (next->centre - arc->centre).norm() > tolerance || !stays(executedBlock(ctx)) ||
        !stays(ahead.executed()))
      return false;
    const Vector from = next->from - next->centre, to = next->to - next->centre;
    if (cross(from, to) * (next->clockwise ? -1 : 1) >= -0.34 * from.norm() * to.norm())
      return false;
    const bool told = memory().round == ctx.blockRange();
    memory().round = ahead.range();
    if (told)
      return true;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("`{0}` leads this arc and the next one more than half round the same centre, "
                   "and so more than once round: the other way round they are parts of one circle",
                   ctx.code(event).name)
          .note(ahead.range(), "the next arc");
    return true;
  }

  /// A lead-in or a lead-out: the line beside it runs straight against the arc.
  static void atOneEnd(const Event &event, bool atEnd, RuleContext &ctx) {
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("this arc of `{0}` goes more than half round, and the path turns straight "
                      "back at its {1}: the other way round it is a short arc that joins it",
                      ctx.code(event).name, atEnd ? "end" : "begin");
  }

  AddressMask planeWords(const RuleContext &ctx) const {
    AddressMask words = 0;
    for (const Axis axis : ctx.arcWords().axes)
      words |= wordsOf_[unsigned(axis)];
    return words;
  }

  /// A full circle between others about the same centre that all go round the other way.
  void amongCircles(const Event &event, RuleContext &ctx) const {
    const bool clockwise = event.motion == MotionKind::ArcCw;
    Block block;
    if (ctx.before().may(Fact::UnknownCode) || !readPrevious(ctx, block) ||
        circleLike(block, ctx) != !clockwise)
      return;
    const SourceRange before = wordsRange(ctx, block);
    Block after;
    BlocksAhead ahead(ctx);
    if (!ahead.next(after) || circleLike(after, ctx) != !clockwise)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("`{0}`: this circle goes round the other way than those before and after it",
                   ctx.code(event).name)
          .note(before, "the circle before it");
  }

  /// The direction of a full circle with the same centre words as the current one: true clockwise.
  std::optional<bool> circleLike(const Block &block, const RuleContext &ctx) const {
    const CodeInfo *const code = findCode(ctx.dialect(), block, {Action::ArcCw, Action::ArcCcw});
    if (!code || !block.items.empty() || block.skip >= 0 || block.hasAny(planeWords(ctx)))
      return std::nullopt;
    const ArcWords &words = ctx.arcWords();
    for (size_t i = 0; i < 2; ++i) {
      const Word *const word = block.find(words.centreAddress[i]);
      if ((word != nullptr) != (words.centre[i] != nullptr) ||
          (word && (!word->isNumber() || !words.centre[i]->isNumber() ||
                    word->value() != words.centre[i]->value())))
        return std::nullopt;
    }
    return code->action == Action::ArcCw;
  }

  /// An arc by its radius after a line: whether it joins its neighbours smoothly, or would do so
  /// when it were turned the other way round.
  void byRadius(const Event &event, RuleContext &ctx) const {
    if (ctx.before().may(Fact::UnknownCode) ||
        ctx.before().activeAction(ctx.dialect(), StandardGroup::Motion) != Action::Linear ||
        (ctx.dialect().group(StandardGroup::Distance) != noGroup &&
         !readsAbsolute(ctx.dialect(), ctx.before())))
      return sleepInShape();
    if (!mayJoinAhead(event, ctx))
      return;
    const auto arc = contourElementOf(executedBlock(ctx));
    const auto before = arc && arc->arc ? directionBefore(ctx) : std::nullopt;
    if (!before)
      return;
    const Vector chord = (arc->to - arc->from).normalized();
    const auto turned = [&](const Vector &way) { return turnedAbout(chord, way); };
    const Vector begin = arc->direction(arc->from), end = arc->direction(arc->to);
    const bool joins = begin.dot(*before) > smooth;
    if (!joins && turned(begin).dot(*before) < smooth)
      return byOtherRadius(event, *arc, *before, ctx);
    if (joins ? memory().joins : memory().turned.size() > 1) // nothing new
      return;
    if (begin.dot(turned(begin)) > corner)
      return;
    PathAhead ahead(ctx);
    const auto next = ahead.next() ? contourElementOf(ahead.executed()) : std::nullopt;
    if (!next || next->length() < arc->radius() / 2) // no element of a contour: the tool goes away
      return;
    const Vector after = next->direction(next->from);
    if (joins)
      memory().joins |= end.dot(after) > smooth;
    else if (turned(end).dot(after) > smooth && memory().turned.size() < 2) {
      memory().turned[{ctx.source().id(), ctx.block().begin}] = ctx.blockRange();
      memory().turnsWork = ctx.dialect().isLathe() || ncvet::turnsWork(ctx.dialect(), ctx.after());
    }
  }

  /// A corner at both ends, where the arc with another radius over the same chord makes none.
  void byOtherRadius(const Event &event, const ContourElement &arc, const Vector &before,
                     RuleContext &ctx) const {
    constexpr double flattest = 0.17; // sine of ten degrees to the chord
    constexpr double alike = 0.05;    // of the radius
    constexpr double little = 0.02;   // mm: coordinates are rounded
    const Vector chord = (arc.to - arc.from).normalized();
    const double sine = cross(before, chord) * (event.motion == MotionKind::ArcCw ? -1 : 1);
    const double radius = distance(arc.from, arc.to) / (2 * sine);
    if (memory().other.size() > 1 || sine < flattest || before.dot(chord) < -1e-6 ||
        std::fabs(radius - arc.radius()) < std::max(alike * arc.radius(), little))
      return;
    PathAhead ahead(ctx);
    const auto next = ahead.next() ? contourElementOf(ahead.executed()) : std::nullopt;
    if (!next || next->length() < radius / 2 ||
        turnedAbout(chord, before).dot(next->direction(next->from)) <= smooth)
      return;
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    if (!unit)
      return;
    const Word &word = *ctx.arcWords().radius;
    memory().other[{ctx.source().id(), ctx.block().begin}] = {ctx.range(word), radius / *unit};
  }

  static void tellRadius(const OtherRadius &arc, RuleContext &ctx) {
    if (auto finding = ctx.report(arc.range))
      finding.message("the arc of `{0}` makes a corner at both of its ends, and with a radius of "
                      "{1} it would join them smoothly, as others of the file do",
                      ctx.text(arc.range), shortNumber(std::round(arc.radius * 10'000) / 10'000));
  }

  /// An arc of more than half a turn, which its sign makes it, that would join both neighbours
  /// smoothly without the sign.
  static void byNegativeRadius(const Event &event, RuleContext &ctx) {
    if (ctx.before().may(Fact::UnknownCode))
      return;
    const auto arc = contourElementOf(executedBlock(ctx));
    const auto before = arc && arc->arc ? directionBefore(ctx) : std::nullopt;
    if (!before)
      return;
    const Vector chord = (arc->to - arc->from).normalized();
    const auto shorter = [&](const Vector &at) {
      return Vector(-turnedAbout(chord, arc->direction(at)));
    };
    if (shorter(arc->from).dot(*before) <= smooth)
      return;
    PathAhead ahead(ctx);
    const auto next = ahead.next() ? contourElementOf(ahead.executed()) : std::nullopt;
    if (!next || shorter(arc->to).dot(next->direction(next->from)) <= smooth)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("the sign makes this arc of `{0}` the longer one, with a corner at both of its "
                   "ends: without it the arc joins both neighbours smoothly",
                   ctx.code(event).name)
          .note(ahead.range(), "the next element");
  }

  /// The way where an arc over that chord, a vector of length one, is turned the other way round.
  static Vector turnedAbout(const Vector &chord, const Vector &way) {
    return 2 * way.dot(chord) * chord - way;
  }

  /// An arc over the chord may go on into that way smoothly, in less than half a turn.
  static bool isChordOfCorner(const Vector &chord, const Vector &next) {
    constexpr double straight = 0.98;
    return chord.dot(next) > -1e-6 && chord.dot(next) < straight;
  }

  /// False: by the text of the next block it goes on neither as the arc ends nor as it would when
  /// it were turned the other way round, or not in the one of both of which there is something to
  /// learn.
  bool mayJoinAhead(const Event &event, const RuleContext &ctx) const {
    constexpr double nearly = smooth - 1e-6;
    const ArcGeometry &arc = ctx.arc();
    const bool clockwise = event.motion == MotionKind::ArcCw;
    const bool isKnown = ctx.outcome().known && arc.start && arc.end && arc.radius;
    const auto centre =
        isKnown ? centreByRadius(*arc.start, *arc.end, *arc.radius, clockwise) : std::nullopt;
    const auto next = centre ? directionAhead(ctx) : std::nullopt;
    if (!next)
      return true;
    const Vector end = leftOf(*arc.end - *centre).normalized() * (clockwise ? -1 : 1);
    const Vector chord = (*arc.end - *arc.start).normalized();
    if ((!memory().joins && end.dot(*next) > nearly) ||
        (memory().turned.size() <= 1 && turnedAbout(chord, end).dot(*next) > nearly) ||
        (memory().other.size() <= 1 && end.dot(*next) < slight && isChordOfCorner(chord, *next)))
      return true;
    const Block &block = *ctx.nextAlike();
    ctx.index().noteRead(block.begin, block.next);
    return false;
  }

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
    const auto direction = directionAhead(ctx);
    if (!direction || end.dot(*direction) <= cosine_)
      return false;
    const Block &next = *ctx.nextAlike();
    ctx.index().noteRead(next.begin, next.next);
    return true;
  }

  /// Direction in which the next block begins, where its text tells it.
  static std::optional<Vector> directionAhead(const RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const MachineState &state = ctx.after();
    const std::array<Axis, 2> axes = ctx.arcWords().axes;
    const Interval &x = state.at(axes[0]), &y = state.at(axes[1]);
    if (!x.isConstant() || !y.isConstant() || !keepsLengths(state.frames) ||
        (dialect.isLathe() && !ctx.outcome().known) ||
        (dialect.group(StandardGroup::Diameter) != noGroup && axes[0] == Axis::Z) ||
        !readsAbsolute(dialect, state))
      return std::nullopt;
    const Block *const next = ctx.nextAlike();
    const auto unit = next && next->skip < 0 ? millimetresPer(dialect, state) : std::nullopt;
    if (!unit)
      return std::nullopt;
    const std::array<double, 2> lengths{*unit / dialect.lengthsPerUnit(axes[0]),
                                        *unit / dialect.lengthsPerUnit(axes[1])};
    const Point from(x.value() / dialect.lengthsPerUnit(axes[0]),
                     y.value() / dialect.lengthsPerUnit(axes[1]));
    return beginOf(*next, from, lengths, *unit, ctx);
  }

  /// Whether words of axes are coordinates.
  static bool readsAbsolute(const Dialect &dialect, const MachineState &state) {
    if (dialect.group(StandardGroup::Distance) == noGroup)
      return dialect.isLathe();
    return state.isActive(dialect, StandardGroup::Distance, {Action::Absolute}) == Truth::Yes;
  }

  /// Direction in which a move begins by the words of its block, which names its code. `lengths`:
  /// of each axis, millimetres per unit. On a lathe of lines alone.
  static std::optional<Vector> beginOf(const Block &block, const Point &from,
                                       const std::array<double, 2> &lengths, double unit,
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
          to[i] = word.value() * lengths[i];
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
    if (!isArc(action) || hasCentre == radius.has_value() || ctx.arc().centreAbsolute ||
        ctx.dialect().isLathe())
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

  static constexpr double smooth = 0.9996, corner = 0.94,
                          slight = 0.98; ///< cosines of 1.6, 20 and 11 degrees
  double cosine_ = 0;                    ///< of the turn from which on the path doubles back
  std::array<AddressMask, axisCount + 1> wordsOf_{}; ///< the words of each axis
};

} // namespace
NCVET_RULE(ArcDoublesBack, arc_doubles_back)
} // namespace ncvet
