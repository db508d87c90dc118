// Two blocks that the control has to intersect are incomplete or do not meet.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/corner_words.h"
#include "analyzer/facts/defined_elements.h"
#include "analyzer/facts/element_geometry.h"
#include "analyzer/facts/turning_profile.h"
#include "formats/dialect/control_facts.h"
#include "interp/cycles/contour_cycle.h"
#include "interp/geometry/line.h"
#include "interp/path/arc_block.h"

#include <bit>
#include <cmath>

namespace ncvet {
namespace {

struct ContourIntersectionInvalidMemory {
  std::optional<ElementGeometry> last; ///< the block before was this element
  ElementTable table;
};

/// A control that intersects has the angle with a comma and compensation.
class ContourIntersectionInvalid final : public StatefulRule<ContourIntersectionInvalidMemory> {
public:
  void listen(Subscriptions &to) override {
    open_ = to.dialect().lineAngleWords != 0;
    elements_ = to.dialect().elementWords;
    if (open_)
      to.onChange({EventKind::Motion});
    if (elements_)
      to.on(EventKind::Motion);
    if (llvm::any_of(to.dialect().codes,
                     [](const CodeInfo &code) { return has(code, CycleTrait::Turned); }))
      to.on(EventKind::CycleRun);
    if (open_)
      to.onAction({Action::Linear, Action::ArcCw, Action::ArcCcw});
    if (elements_)
      to.onAction({Action::DefineElement});
    // The next block names an over-determined element; only controls with an `I` operator do it.
    if ((cornerAddresses(to.dialect()).angle & maskOf(commaA)) &&
        to.dialect().facts->corners.intersects)
      to.onChange({EventKind::Motion, EventKind::Block});
    else
      ownOnly_ = true;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun)
      return parallelPasses(event, ctx);
    const Block &block = ctx.block();
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    if (event.kind == EventKind::Code && (open_ || elements_))
      return ctx.code(event).action == Action::DefineElement ? memory().table.define(ctx)
                                                             : nothingGiven(ctx);
    if (event.kind == EventKind::Motion) {
      if (open_)
        openElement(event, ctx);
      if (elements_) {
        outside(event, ctx);
        joint(ctx);
      }
    }
    if (ownOnly_)
      return;
    if (event.kind == EventKind::Block) {
      // A line of which only the angle is given, before a circle.
      if (block.has(commaA) && !(axesOf(ctx, block) & plane))
        lineAndCircle(ctx);
      return;
    }
    if (!event.certain || ctx.before().profile == ProfileMode::Recorded)
      return;
    if (isArc(event.motion))
      return afterArc(event, plane, ctx);
    const bool line = event.motion == MotionKind::Feed || event.motion == MotionKind::Rapid;
    if (!line || !block.has(commaA) || (axesOf(ctx, block) & plane) != plane)
      return;
    // Both coordinates and the angle: it is intersected with the element before.
    if (ctx.before().compensation == phaseOff && ctx.after().compensation == phaseOff) {
      if (auto finding = ctx.report(event))
        finding.message(
            "this line has its end and its angle, so that it is to be intersected with the "
            "element before, but compensation is off (G41 or G42, with D00 for none)");
      return;
    }
    previous(event, plane, ctx);
  }

private:
  /// A line of which only the direction is given, or an arc of which only the circle, ends where
  /// the next element begins.
  void openElement(const Event &event, RuleContext &ctx) const {
    const Word *angle = ctx.block().findAny(ctx.dialect().lineAngleWords);
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    const bool arc = isArc(event.motion);
    const ArcWords &words = ctx.arcWords();
    const bool circle = arc && ctx.dialect().facts->arcs.centreAndEnd && words.radius &&
                        words.hasCentre() && !words.angle && !angle;
    if (!(circle || (angle && event.motion == MotionKind::Feed)) ||
        (axesOf(ctx, ctx.block()) & plane) ||
        ctx.block().hasAny(maskOf('D') | elements_ | ctx.dialect().cornerWords))
      return;
    BlocksAhead ahead(ctx);
    Block next;
    if (ahead.next(next)
            ? (axesOf(ctx, next) & plane) || !next.items.empty() ||
                  next.hasAny(ctx.dialect().lineAngleWords | elements_ | lettersMask("IJKR"))
            : !ahead.isOver())
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("this {0} and no end, and no element follows that gives it one",
                      circle ? "arc has a circle" : "line has a direction");
  }

  /// An element by its name where no contour is made.
  void outside(const Event &, RuleContext &ctx) const {
    const Word *word = ctx.block().findAny(elements_);
    if (!word || ctx.before().compensation != phaseOff || ctx.after().compensation != phaseOff ||
        ctx.before().profile != ProfileMode::Off || ctx.after().profile != ProfileMode::Off ||
        ctx.before().may(Fact::UnknownCode) || ctx.callDepth() > 0 || ctx.block().words.size() > 1)
      return;
    if (auto finding = ctx.report(*word))
      finding.severity(Severity::Warning)
          .message("`{0}` is an element of a contour, and none is made here: compensation is off",
                   ctx.text(*word));
  }

  /// A motion code and nothing else in a contour, and the next element brings its own: what it
  /// should have drawn is missing.
  void nothingGiven(RuleContext &ctx) const {
    const bool contour =
        ctx.before().profile == ProfileMode::Recorded ||
        (ctx.before().compensation == phaseOn && ctx.after().compensation == phaseOn);
    BlocksAhead ahead(ctx);
    Block next;
    if (!contour || ctx.block().words.size() != 1 || !ctx.block().items.empty() ||
        !ahead.next(next) || !next.items.empty() ||
        !findCode(ctx.dialect(), next,
                  {Action::Rapid, Action::Linear, Action::ArcCw, Action::ArcCcw}))
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("this element of the contour has no data, and the next one cannot give them");
  }

  /// Two named elements, one after the other, that have no point in common.
  void joint(RuleContext &ctx) const {
    const Word *word = ctx.block().findAny(elements_);
    const ElementGeometry *element = word ? memory().table.find(*word) : nullptr;
    if (!element || !ctx.after().frames.empty() || ctx.block().hasAny(ctx.dialect().cornerWords)) {
      memory().last.reset();
      return;
    }
    const bool alone = DefinedElements::alone(ctx);
    if (alone && memory().last && memory().last->switches == element->switches &&
        !meet(*memory().last, *element))
      if (auto finding = ctx.report(*word))
        finding.message("`{0}` and the element before it do not meet: they have no point in "
                        "common",
                        ctx.text(*word));
    // Beside a code of compensation an element may be one that is only touched.
    if (alone || element->kind == ElementGeometry::Kind::Point)
      memory().last = *element;
    else
      memory().last.reset();
  }

  /// Passes at a distance from the contour are led to where its lines meet, and two that follow
  /// each other in one direction never do (rs274 of LinuxCNC 2.9: "Cannot intersect parallel
  /// lines"). Only along an axis is that sure: elsewhere it hangs on the last digit.
  static void parallelPasses(const Event &event, RuleContext &ctx) {
    const auto cycle = contourCycle(
        {ctx.dialect(), ctx.machine(), ctx.block(), ctx.outcome(), ctx.before(), ctx.after()});
    if (!cycle || !cycle->profile || !cycle->profile->keepsDistance())
      return;
    const Profile profile = readProfile(ctx);
    if (!profile.known)
      return;
    const ProfileBlock *before = nullptr;
    uint16_t along = 0;
    bool begun = false; // the first move leads to the contour
    for (size_t i = 0; i < profile.lastCut; ++i) {
      const ProfileBlock &block = profile.blocks[i];
      if (!block.moves)
        continue;
      uint16_t moved = 0;
      if (!(block.fromX == block.toX))
        moved |= 1u << unsigned(Axis::X);
      if (!(block.fromZ == block.toZ))
        moved |= 1u << unsigned(Axis::Z);
      const bool known = block.fromX.isConstant() && block.fromZ.isConstant() &&
                         block.toX.isConstant() && block.toZ.isConstant() && block.motionKnown;
      if (begun && known && !moved)
        continue;
      const bool line = begun && known && std::popcount(unsigned(moved)) == 1 &&
                        (block.motion == MotionKind::Feed || block.motion == MotionKind::Rapid);
      if (line && before && moved == along) {
        if (auto finding = ctx.report(event, event.certain))
          finding
              .message("`{0}` stops: it leads its passes to where the lines of the contour meet, "
                       "and these two run in one direction",
                       ctx.code(event).name)
              .note(before->range, "a line")
              .note(block.range, "and the next one");
        return;
      }
      before = line ? &block : nullptr;
      along = moved;
      begun = true;
    }
  }

  bool open_ = false;        ///< lines may be given by their direction
  bool ownOnly_ = false;     ///< no lines that are intersected by a comma word
  AddressMask elements_ = 0; ///< names of elements
  /// The last block with a move before this one.
  static void previous(const Event &event, uint16_t plane, RuleContext &ctx) {
    Block last;
    if (!readPrevious(ctx, last))
      return;
    if (findCode(ctx.dialect(), last, {Action::ArcCw, Action::ArcCcw})) {
      selector(ctx.block(), ctx.blockRange(), ctx);
      incremental(ctx.block(), ctx.blockRange(), ctx);
      return;
    }
    parallel(event, last, plane, ctx);
  }

  /// Two lines: the one before by its end points, this one by its end and its angle.
  static void parallel(const Event &event, const Block &last, uint16_t plane, RuleContext &ctx) {
    if (last.has(commaA))
      return parallelAngles(event, last, ctx);
    if (std::popcount(unsigned(plane)) != 2)
      return;
    const Word *angleWord = ctx.block().find(commaA);
    const Interval angle = ctx.value(*angleWord);
    if (!angle.isConstant())
      return;
    // The line before ran to where the tool is now; its direction is that of its only axis.
    uint16_t moved = axesOf(ctx, last) & plane;
    if (std::popcount(unsigned(moved)) == 2) {
      // `X10 Y0` after `X0 Y0`: the start is not kept, only an unchanged coordinate would show.
      const auto start = startOf(ctx, last, plane);
      if (!start)
        return;
      moved = *start;
    }
    if (std::popcount(unsigned(moved)) != 1)
      return;
    constexpr uint16_t x = 1u << unsigned(Axis::X), y = 1u << unsigned(Axis::Y),
                       z = 1u << unsigned(Axis::Z);
    const uint16_t first = plane == (x | z) ? z : plane == (y | z) ? y : x;
    const double a = std::fabs(std::fmod(angle.value(), 180.0));
    const bool alongFirst = a < 1e-9 || a > 180 - 1e-9;
    const bool alongSecond = std::fabs(a - 90) < 1e-9;
    if (!(moved == first ? alongFirst : alongSecond))
      return;
    if (auto finding = ctx.report(*angleWord, event.certain))
      finding
          .message("this line at `{0}` and the one before run parallel: they do not meet",
                   ctx.text(*angleWord))
          .note(ctx.range(last), "the line before");
  }

  /// Two lines by their angles.
  static void parallelAngles(const Event &event, const Block &last, RuleContext &ctx) {
    const Word &angleWord = *ctx.block().find(commaA);
    const Word &before = *last.find(commaA);
    const Interval angle = ctx.value(angleWord);
    if (!before.isNumber() || !angle.isConstant() ||
        std::fabs(std::remainder(angle.value() - before.value(), 180.0)) > 1e-6)
      return;
    if (auto finding = ctx.report(angleWord, event.certain))
      finding
          .message("this line at `{0}` and the one before run parallel: they do not meet",
                   ctx.text(angleWord))
          .note(ctx.range(last), "the line before");
  }

  /// Which single axis changed in `last`, by looking at the block before it.
  static std::optional<uint16_t> startOf(const RuleContext &ctx, const Block &last,
                                         uint16_t plane) {
    if (last.begin == 0)
      return std::nullopt;
    Block before;
    ctx.index().read(ctx.source().lines().lineBegin(last.begin - 1), before);
    uint16_t changed = 0;
    for (const Word &word : last.words) {
      const AddressInfo &address = ctx.dialect().addresses[word.address];
      if (address.kind != AddressKind::Axis || !(plane >> unsigned(address.axis) & 1))
        continue;
      const Word *was = before.find(word.address);
      if (!was || !was->isNumber() || !word.isNumber() || was->has(wordIncremental) ||
          word.has(wordIncremental))
        return std::nullopt;
      if (was->value() != word.value())
        changed |= uint16_t(1u << unsigned(address.axis));
    }
    return changed;
  }

  /// A line by angle alone, then a circle that has to be complete.
  static void lineAndCircle(RuleContext &ctx) {
    BlocksAhead ahead(ctx);
    Block next;
    if (!ahead.next(next) || !next.items.empty() ||
        !findCode(ctx.dialect(), next, {Action::ArcCw, Action::ArcCcw}))
      return;
    const SourceRange range = ahead.range(next);
    const unsigned centres = unsigned(next.has(letterAddress('I'))) +
                             unsigned(next.has(letterAddress('J'))) +
                             unsigned(next.has(letterAddress('K')));
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    if (centres < 2 || !next.has(letterAddress('R')) || (axesOf(ctx, next) & plane) != plane) {
      if (auto finding = ctx.report(range))
        finding.message(
            "this circle is to be intersected with the line before: it needs its end, its "
            "centre and R");
      return;
    }
    selector(next, range, ctx);
    incremental(next, range, ctx);
    misses(next, range, ctx);
    if (ctx.after().compensation == phaseOff)
      if (auto finding = ctx.report(range))
        finding.message(
            "this circle is to be intersected with the line before, but compensation is off "
            "(G41 or G42, with D00 for none)");
  }

  static void selector(const Block &block, SourceRange range, RuleContext &ctx) {
    const Word *q = block.find('Q');
    if (q && (!q->isNumber() || q->mantissa != 0))
      return;
    if (q)
      range = {ctx.source().id(), q->offset, block.endOf(*q)};
    if (auto finding = ctx.report(range))
      finding.message(
          q ? "Q0 selects neither of the two points in which the elements meet"
            : "a line and a circle meet in two points: Q below 0 selects the first, above 0 the "
              "second");
  }

  /// The current line, by its angle, passes beside the circle of the next block.
  static void misses(const Block &next, SourceRange range, RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const auto circle = writtenCircle(next, ctx);
    const Interval angle = ctx.value(*ctx.block().find(commaA));
    const auto axes = planeOrder(ctx.dialect(), state);
    const auto x = placeInPlane(ctx.dialect(), state, axes[0]);
    const auto y = placeInPlane(ctx.dialect(), state, axes[1]);
    if (!circle || !angle.isConstant() || !x || !y)
      return;
    const double away =
        distanceFromLine({*x, *y}, radiansOf(angle.value()), {circle->x, circle->y});
    if (away <= circle->radius + tolerance)
      return;
    if (auto finding = ctx.report(range))
      finding
          .message("the line before passes {0:f3} mm from the centre of this circle, whose radius "
                   "is {1:f3} mm: they do not meet",
                   away, circle->radius)
          .note(ctx.blockRange(), "the line");
  }

  /// An arc, and after it a circle or a line that is to be intersected with it.
  static void afterArc(const Event &event, uint16_t plane, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    // A block with Q is itself the second one of two, and its centre is written otherwise.
    if (dialect.isLathe() || ctx.block().has(letterAddress('Q')) || event.inMachineCoordinates() ||
        ctx.after().compensation == phaseOff || !ctx.after().frames.empty())
      return;
    BlocksAhead ahead(ctx);
    Block next;
    if (!ahead.next(next) || !next.items.empty() || !next.has(letterAddress('Q')) ||
        (axesOf(ctx, next) & plane) != plane)
      return;
    const bool toArc = findCode(dialect, next, {Action::ArcCw, Action::ArcCcw});
    const Word *angle = next.find(commaA);
    if (toArc == bool(angle) || (angle && !findCode(dialect, next, {Action::Linear})))
      return;
    if (toArc && next.has(letterAddress('R')))
      incremental(next, ahead.range(next), ctx);
    const ArcWords &words = ctx.arcWords();
    const ArcGeometry &arc = ctx.arc();
    const auto centre =
        words.hasCentre() ? arc.centre()
        : arc.start && arc.end && arc.radius
            ? centreByRadius(*arc.start, *arc.end, *arc.radius, event.motion == MotionKind::ArcCw)
            : std::nullopt;
    if (!arc.start || !centre)
      return;
    const double radius = distance(*centre, *arc.start);
    double apart = 0;
    bool meet = true;
    if (toArc) {
      const auto circle = writtenCircle(next, ctx);
      if (!circle)
        return;
      apart = distance(*centre, {circle->x, circle->y});
      meet = apart <= radius + circle->radius + tolerance &&
             apart >= std::fabs(radius - circle->radius) - tolerance;
    } else {
      const auto axes = planeOrder(dialect, ctx.after());
      const auto end = writtenPoint(next, axes, ctx);
      if (!end || !angle->isNumber())
        return;
      apart = distanceFromLine(*end, radiansOf(angle->value()), *centre);
      meet = apart <= radius + tolerance;
    }
    if (meet)
      return;
    if (auto finding = ctx.report(wordsRange(ctx, next), event.certain))
      finding
          .message(toArc ? "this circle and the one before do not meet: their centres are {0:f3} "
                           "mm apart"
                         : "this line passes {0:f3} mm from the centre of the circle before and "
                           "does not meet it",
                   apart)
          .note(ctx.blockRange(), "the circle");
  }

  struct Circle {
    double x = 0, y = 0, radius = 0; ///< mm
  };
  static constexpr double tolerance = 0.01; ///< mm: values are written rounded

  /// The circle of a second block: its centre is a place, whatever the distance mode.
  static std::optional<Circle> writtenCircle(const Block &block, const RuleContext &ctx) {
    const MachineState &state = ctx.after();
    const auto unit = millimetresPer(ctx.dialect(), state);
    const ArcWords words = arcWords(ctx.dialect(), state, block);
    const Word *r = block.find('R');
    if (!unit || ctx.dialect().isLathe() || !state.frames.empty() || !words.centre[0] ||
        !words.centre[1] || !r || !r->isNumber())
      return std::nullopt;
    for (const Word *word : words.centre)
      if (!word->isNumber() || word->has(wordIncremental))
        return std::nullopt;
    return Circle{words.centre[0]->value() * *unit, words.centre[1]->value() * *unit,
                  std::fabs(r->value()) * *unit};
  }

  /// The end that the words of a second block give.
  static std::optional<Point> writtenPoint(const Block &block, const std::array<Axis, 2> &axes,
                                           const RuleContext &ctx) {
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    Point place = Point::Zero();
    for (size_t i = 0; i < 2; ++i) {
      const Word *found = nullptr;
      for (const Word &word : block.words)
        if (const AddressInfo &info = ctx.dialect().addresses[word.address];
            info.kind == AddressKind::Axis && info.axis == axes[i])
          found = &word;
      if (!found || !unit || !found->isNumber() || found->has(wordIncremental))
        return std::nullopt;
      place[i] = found->value() * *unit;
    }
    return place;
  }

  /// What is read as absolute is written as an increment.
  static void incremental(const Block &block, SourceRange range, RuleContext &ctx) {
    for (const Word &word : block.words)
      if (word.has(wordIncremental) &&
          ((ctx.dialect().axisWords | lettersMask("IJK")) & maskOf(word.address))) {
        const SourceRange at{ctx.source().id(), word.offset, block.endOf(word)};
        if (auto finding = ctx.report(at))
          finding
              .message("`{0}` is an increment, but the end and the centre of an intersected "
                       "element are read as absolute",
                       ctx.text(at))
              .severity(Severity::Warning);
        return;
      }
    const GroupIndex group = ctx.dialect().group(StandardGroup::Distance);
    if (group == noGroup || ctx.after().group(group) == groupUnset ||
        ctx.after().isActive(ctx.dialect(), StandardGroup::Distance, {Action::Incremental}) !=
            Truth::Yes)
      return;
    if (auto finding = ctx.report(range))
      finding
          .message(
              "G91 is active, but the end and the centre of an intersected element are read as "
              "absolute")
          .severity(Severity::Warning)
          .note(ctx.after().originOf(ctx.dialect(), StandardGroup::Distance),
                "G91 becomes active here");
  }
};

} // namespace
NCVET_RULE(ContourIntersectionInvalid, contour_intersection_invalid)
} // namespace ncvet
