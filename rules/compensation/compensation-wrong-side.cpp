// Radius compensation on the side of the material, or on that which the tool's nose does not have.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/codes_in_force.h"
#include "analyzer/facts/ending_code.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/path_ahead.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/rule/report_once.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "interp/evaluate/tool_data.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ncvet {
namespace {

struct CompensationWrongSideMemory {
  using Point = std::array<Interval, 2>;
  /// Of an entry: from where to where, and its block.
  struct Entry {
    Point from;
    Point to;
    SourceRange block;
  };
  /// The one that waits for its first element. Between contours nothing is remembered: else an edit
  /// would have all that follows it checked again.
  std::optional<Entry> entry;
  OncePerCause noses;
};

class CompensationWrongSide final : public StatefulRule<CompensationWrongSideMemory> {
public:
  void listen(Subscriptions &to) override {
    mills_ = to.flag("mills");
    if (to.dialect().isLathe())
      to.on(EventKind::Motion);
    else
      to.on({EventKind::Motion, EventKind::CompensationMove});
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (ctx.dialect().isLathe()) {
      onLathe(event, ctx);
      besideNose(event, ctx);
      if (ctx.before().compensation != phaseOn)
        sleepInShape();
    } else if (turnsWork(ctx.dialect(), ctx.after())) {
      memory().entry.reset();
      if (event.kind == EventKind::Motion)
        onLathe(event, ctx);
    } else if (event.kind == EventKind::CompensationMove) {
      enters(event, ctx);
    } else {
      if (ctx.before().compensation != phaseOn || !event.axes)
        return sleepInShape();
      if (memory().entry)
        firstElement(event, ctx);
      sleepInStretch(); // the next elements are no first ones
    }
  }

private:
  /// A cut along Z touches the work on one side of the nose: above the centre of a tool that turns
  /// inside (tip codes 1 and 2), below that of one that turns outside (3 and 4). NCT manual, lines
  /// 1440-1445. A full radius may cut on its other side all the same.
  void besideNose(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (event.motion != MotionKind::Feed || event.code == noCode || ctx.machine().tools.empty() ||
        before.compensation != phaseOn || after.compensation != phaseOn ||
        before.may(Fact::UnknownCode))
      return;
    const Interval dz = after.at(Axis::Z) - before.at(Axis::Z);
    const Interval &x = after.at(Axis::X);
    if (!x.isConstant() || !(before.at(Axis::X) == x) || (dz.lo <= 0 && dz.hi >= 0))
      return;
    const ToolData *tool = compensatingTool(ctx.dialect(), ctx.machine(), after);
    const auto radius = compensationRadius(ctx.dialect(), ctx.machine(), after);
    const int8_t side = compensatedSide(ctx.dialect(), after);
    if (!tool || !tool->tip || *tool->tip < 1 || *tool->tip > 4 || !radius || *radius <= 0 || !side)
      return;
    // On the left of a cut towards the chuck lies the axis of the work.
    const bool touchesAbove = (dz.hi < 0) == (side > 0);
    const bool inside = *tool->tip <= 2;
    const Origin &origin = after.origin.of(StatePart::Compensation);
    if (touchesAbove == inside || !memory().noses.speaks(origin, ctx))
      return;
    const CodeInfo *code = after.activeCode(ctx.dialect(), StandardGroup::Compensation);
    if (auto finding = ctx.report(causePlace(ctx, origin).at, /*certain=*/false))
      finding
          .message("`{0}` cuts with the side of the nose at X{1}, and the tool's nose direction "
                   "{2} is that of a tool which turns {3}",
                   code ? code->name : std::string("compensation"), touchesAbove ? "+" : "-",
                   *tool->tip, inside ? "inside" : "outside")
          .note(ctx.blockRange(), "this cut lies along Z");
  }

  /// Looks at the first element after the entry. Cut towards the chuck, an outside contour grows
  /// and a bore shrinks; only when the entry came from the same side is it taken for certain. Else
  /// the side on which the tool leaves the contour tells.
  static void onLathe(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const bool cuts = isFeed(event.motion);
    if (!cuts || event.code == noCode || before.compensation != phaseOn ||
        after.compensation != phaseOn || before.may(Fact::CompensatedCut) ||
        event.inMachineCoordinates() || before.may(Fact::UnknownCode))
      return;
    const uint16_t plane = uint16_t(1u << unsigned(Axis::X) | 1u << unsigned(Axis::Z));
    if (planeAxes(ctx.dialect(), after) != plane)
      return;
    for (const Axis axis : {Axis::X, Axis::Z})
      if (before.inMachineCoordinates(axis) || after.inMachineCoordinates(axis))
        return;
    const Interval dz = after.at(Axis::Z) - before.at(Axis::Z);
    Interval dx = after.at(Axis::X) - before.at(Axis::X);
    if (!(dz.hi < 0) || !(before.at(Axis::X).lo >= 0) || !(after.at(Axis::X).lo >= 0))
      return;
    SourceRange element = ctx.blockRange();
    const bool axial = dx.lo == 0 && dx.hi == 0; // along Z: the element after it tells
    if (axial)
      dx = changeAfterAxial(ctx, element).value_or(Interval::unknown());
    const bool grows = dx.lo > 0 && before.must(Fact::EnteredInward);
    const bool shrinks = dx.hi < 0 && before.must(Fact::EnteredOutward);
    SourceRange leaving;
    const Side side = grows ? Side::Outside : shrinks ? Side::Inside : sideOfLeaving(ctx, leaving);
    if (side == Side::Unknown)
      return;
    const bool outside = side == Side::Outside;
    const CodeInfo *code = after.activeCode(ctx.dialect(), StandardGroup::Compensation);
    const Action right = outside ? Action::CompensationRight : Action::CompensationLeft;
    if (!code || code->action == right ||
        (code->action != Action::CompensationLeft && code->action != Action::CompensationRight))
      return;
    const Origin &origin = after.origin.of(StatePart::Compensation);
    const CodeInfo *const other = firstCodeWith(ctx.dialect(), right);
    if (auto finding = ctx.report(causePlace(ctx, origin).at, event.certain))
      finding
          .message("`{0}` on {1} cut towards the chuck: the nose runs on the side of the material, "
                   "`{2}` belongs there",
                   code->name, outside ? "an outside contour" : "a bore",
                   other ? other->name : "the other side")
          .note(leaving.empty() ? element : leaving,
                !leaving.empty() ? "here the tool leaves the contour at its depth"
                : outside        ? "here the contour grows"
                                 : "here the bore shrinks");
  }

  /// How X changes in the first element towards the chuck that follows moves along Z; `where`
  /// becomes its place.
  static std::optional<Interval> changeAfterAxial(const RuleContext &ctx, SourceRange &where) {
    PathAhead ahead(ctx);
    constexpr unsigned mostMoves = 4;
    for (unsigned i = 0; i < mostMoves && ahead.next(); ++i) {
      const ExecutedBlock move = ahead.executed();
      const CodeInfo *motion = move.after.activeCode(ctx.dialect(), StandardGroup::Motion);
      if (move.after.compensation != phaseOn || move.before.compensation != phaseOn || !motion ||
          (motion->action != Action::Linear && !isArc(motion->action)) ||
          findCode(ctx.dialect(), move.block,
                   {Action::MachineMove, Action::CompensationLeft, Action::CompensationRight,
                    Action::CompensationOff}))
        return std::nullopt;
      const Interval dz = move.after.at(Axis::Z) - move.before.at(Axis::Z);
      const Interval dx = move.after.at(Axis::X) - move.before.at(Axis::X);
      if (!(dz.hi < 0))
        return std::nullopt;
      if (dx.lo == 0 && dx.hi == 0)
        continue;
      where = ahead.range();
      return dx;
    }
    return std::nullopt;
  }

  /// On which side of the contour the tool leaves it: with the end of compensation it goes past all
  /// that it has cut, in X alone, at a depth in Z. Only on the free side is there room for that.
  static Side sideOfLeaving(const RuleContext &ctx, SourceRange &leaving) {
    constexpr unsigned mostMoves = 60;
    const Interval &first = ctx.before().at(Axis::X);
    double least = std::min(first.lo, ctx.after().at(Axis::X).lo);
    double greatest = std::max(first.hi, ctx.after().at(Axis::X).hi);
    PathAhead ahead(ctx);
    for (unsigned i = 0; i < mostMoves && ahead.next(); ++i) {
      const ExecutedBlock move = ahead.executed();
      const Interval &to = move.after.at(Axis::X);
      if (!to.isConstant() ||
          findCode(ctx.dialect(), move.block,
                   {Action::MachineMove, Action::CompensationLeft, Action::CompensationRight}))
        return Side::Unknown;
      if (move.after.compensationActive(ctx.dialect()) == Truth::Yes) {
        least = std::min(least, to.value());
        greatest = std::max(greatest, to.value());
        continue;
      }
      const Interval dz = move.after.at(Axis::Z) - move.before.at(Axis::Z);
      const bool atDepth =
          dz.lo == 0 && dz.hi == 0 && move.after.at(Axis::Z).hi < ctx.before().at(Axis::Z).lo;
      if (!atDepth || (to.value() >= least && to.value() <= greatest))
        return Side::Unknown;
      leaving = ahead.range();
      return to.value() > greatest ? Side::Outside : Side::Inside;
    }
    return Side::Unknown;
  }

  /// The position in the plane.
  static Memory::Point pointOf(const MachineState &state, const Dialect &dialect) {
    const auto [first, second] = planeOrder(dialect, state);
    return {state.at(first), state.at(second)};
  }

  void enters(const Event &event, RuleContext &ctx) const {
    // With AGAP=N the block of the code is the first element itself.
    // Where the tool is says nothing of where a recorded section begins.
    const bool waits = event.code != noCode && ctx.code(event).action != Action::CompensationOff &&
                       ctx.before().profile != ProfileMode::Recorded &&
                       ctx.machine().option("agap").value_or("") != "N";
    memory().entry.reset();
    if (waits)
      memory().entry = Memory::Entry{pointOf(ctx.before(), ctx.dialect()),
                                     pointOf(ctx.after(), ctx.dialect()), ctx.blockRange()};
  }

  /// A closed contour that the tool comes to from outside, and leaves to outside, at one depth, and
  /// along which it is kept inside, or the other way round: it cuts through it on both ways.
  bool throughContour(const Memory::Entry &entry, const CodeInfo &code, const Event &event,
                      RuleContext &ctx) const {
    constexpr unsigned longest = 200; // elements
    constexpr double tolerance = 1e-3;
    const Interval &depth = ctx.before().at(Axis::Z);
    if (!depth.isConstant() || !(ctx.after().at(Axis::Z) == depth))
      return false;
    Outline outline;
    outline.add(entry.to);
    outline.add(pointOf(ctx.after(), ctx.dialect()));
    const bool firstIsLine = event.motion == MotionKind::Feed;
    Action last = Action::Linear;
    const Action first = isArc(event.motion)
                             ? ctx.after().activeAction(ctx.dialect(), StandardGroup::Motion)
                             : Action::Linear;
    Turns turns;
    turns.count(first, 1);
    std::optional<ContourElement> circle =
        firstIsLine ? std::nullopt : wholeCircle(executedBlock(ctx));
    PathAhead ahead(ctx);
    for (unsigned i = 0; i < longest && ahead.next(); ++i) {
      const ExecutedBlock move = ahead.executed();
      const Memory::Point to = pointOf(move.after, ctx.dialect());
      if (!to[0].isConstant() || !to[1].isConstant() || !(move.after.at(Axis::Z) == depth))
        return false;
      if (move.after.compensation == phaseOn) {
        last = move.after.activeAction(ctx.dialect(), StandardGroup::Motion);
        turns.count(last, 1);
        if (!circle && isArc(last))
          circle = wholeCircle(move);
        outline.widenBy(move);
        outline.add(to);
        continue;
      }
      if (firstIsLine && last == Action::Linear)
        outline.closeAtCrossing();
      leaveOutArcs(first, last, outline, turns);
      // Where no arc goes into the outline its corners hold nothing that lies outside of it.
      const bool left = code.action == Action::CompensationLeft;
      const bool isHollow = (outline.area() > 0 ? turns.cw : turns.ccw) != 0;
      const bool inside = circle ? circle->clockwise != left : (outline.area() > 0) == left;
      const bool crosses = circle   ? liesOther(*circle, inside, entry.from, to)
                           : inside ? !outline.boxHolds(entry.from) && !outline.boxHolds(to)
                                    : !isHollow && outline.holds(entry.from) && outline.holds(to);
      if (!crosses || (!circle && !outline.isClosedArea(tolerance)))
        return false;
      const Origin &origin = ctx.after().origin.of(StatePart::Compensation);
      if (auto finding = ctx.report(causePlace(ctx, origin, entry.block).at, event.certain))
        finding
            .message("`{0}` keeps the tool {1} of this closed contour, and it comes from {2} and "
                     "leaves to {2}: it cuts through the contour",
                     code.name, inside ? "inside" : "outside", inside ? "outside" : "inside")
            .note(ahead.range(), "here it leaves");
      return true;
    }
    return false;
  }

  /// The whole turn that the block makes; none: it makes no such.
  static std::optional<ContourElement> wholeCircle(const ExecutedBlock &move) {
    constexpr double tolerance = 1e-3; // mm
    const auto element = contourElementOf(move);
    return element && element->arc && (element->from - element->to).norm() < tolerance
               ? element
               : std::nullopt;
  }

  /// Whether both points lie on the other side of the circle than the tool is kept on.
  static bool liesOther(const ContourElement &circle, bool inside, const Memory::Point &from,
                        const Memory::Point &to) {
    const auto isInside = [&](const Memory::Point &point) {
      return (Vector(point[0].lo, point[1].lo) - circle.centre).norm() < circle.radius();
    };
    return isInside(from) != inside && isInside(to) != inside;
  }

  /// How many arcs of a contour turn each way.
  struct Turns {
    int cw = 0, ccw = 0;

    void count(Action motion, int by) {
      cw += motion == Action::ArcCw ? by : 0;
      ccw += motion == Action::ArcCcw ? by : 0;
    }
  };

  /// Corners of a contour in the plane, arcs by their ends.
  class Outline {
  public:
    void add(const Memory::Point &point) { corners_.emplace_back(point[0].lo, point[1].lo); }

    /// The box about it holds all of the circle of which a block makes a part, as soon as another
    /// one follows: the last one may lead away.
    void widenBy(const ExecutedBlock &move) {
      widen();
      arc_ = contourElementOf(move);
    }
    void widen() {
      if (arc_ && arc_->arc) {
        arcsLow_ = arcsLow_.cwiseMin(arc_->centre - Vector::Constant(arc_->radius()));
        arcsHigh_ = arcsHigh_.cwiseMax(arc_->centre + Vector::Constant(arc_->radius()));
      }
      arc_.reset();
    }

    /// The first and the last element, lines both, go on past the corner at which they meet: the
    /// contour begins and ends there. Where they lie on one line it does so at the first corner.
    void closeAtCrossing() {
      if (corners_.size() < 5 || isClosed(0))
        return;
      const Vector start = corners_[0], end = corners_.back();
      const Vector first = corners_[1] - start, last = end - corners_[corners_.size() - 2];
      const double turn = cross(first, last), scale = first.norm() * last.norm();
      if (std::fabs(turn) > 1e-6 * scale) {
        const Vector between = corners_[corners_.size() - 2] - start;
        const double onFirst = cross(between, last) / turn, onLast = cross(between, first) / turn;
        if (onFirst < 0 || onFirst > 1 || onLast < 0 || onLast > 1)
          return;
        corners_.front() = corners_.back() = start + onFirst * first;
      } else if (std::fabs(cross(end - start, first)) <= 1e-6 * scale && first.dot(last) > 0 &&
                 (end - start).dot(first) >= 0 &&
                 (corners_[corners_.size() - 2] - start).dot(first) >= 0 &&
                 (corners_[1] - end).dot(first) >= 0) {
        corners_.front() = end;
      }
    }

    /// The first and the last element, arcs both, lead to the contour and away from it: it begins
    /// and ends where they meet it.
    bool leaveOutEnds(double tolerance) {
      if (corners_.size() < 6 || isClosed(tolerance) ||
          (corners_[1] - corners_[corners_.size() - 2]).norm() > tolerance)
        return false;
      corners_.erase(corners_.begin());
      corners_.pop_back();
      return true;
    }

    bool isClosed(double tolerance) const {
      return corners_.size() > 3 && (corners_.front() - corners_.back()).norm() <= tolerance;
    }
    /// Whether it is, and what it holds is no sliver.
    bool isClosedArea(double tolerance) const {
      const double area = std::fabs(this->area());
      return isClosed(tolerance) && area >= tolerance && area >= 0.1 * boxArea();
    }
    /// Of a closed one; positive: counter-clockwise.
    double area() const {
      double area = 0;
      for (size_t i = 1; i < corners_.size(); ++i)
        area += 0.5 * cross(corners_[i - 1], corners_[i]);
      return area;
    }
    double boxArea() const { return (high() - low()).prod(); }
    /// Whether the point lies between the corners.
    bool holds(const Memory::Point &point) const {
      const Vector at(point[0].lo, point[1].lo);
      bool inside = false;
      for (size_t i = 1; i < corners_.size(); ++i) {
        const Vector from = corners_[i - 1] - at, to = corners_[i] - at;
        if ((from.y() > 0) != (to.y() > 0) && (cross(from, to) > 0) == (to.y() > from.y()))
          inside = !inside;
      }
      return inside;
    }
    /// Whether it lies in the box about them.
    bool boxHolds(const Memory::Point &point) const {
      const Vector low = this->low().cwiseMin(arcsLow_), high = this->high().cwiseMax(arcsHigh_);
      return point[0].lo >= low.x() && point[0].lo <= high.x() && point[1].lo >= low.y() &&
             point[1].lo <= high.y();
    }

  private:
    Vector low() const {
      Vector low = corners_.front();
      for (const Vector &corner : corners_)
        low = low.cwiseMin(corner);
      return low;
    }
    Vector high() const {
      Vector high = corners_.front();
      for (const Vector &corner : corners_)
        high = high.cwiseMax(corner);
      return high;
    }

    std::vector<Vector> corners_;
    std::optional<ContourElement> arc_; ///< of the last block
    Vector arcsLow_ = Vector::Constant(std::numeric_limits<double>::infinity());
    Vector arcsHigh_ = -arcsLow_;
  };

  /// Arcs that lead to the contour and away from it are none of its elements.
  static void leaveOutArcs(Action first, Action last, Outline &outline, Turns &turns) {
    constexpr double tolerance = 1e-3; // mm
    if (!isArc(first) || !isArc(last) || !outline.leaveOutEnds(tolerance))
      return outline.widen();
    turns.count(first, -1);
    turns.count(last, -1);
  }

  /// A mill that comes from beside the first element has to come from the side on which it stays.
  void firstElement(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before(), &after = ctx.after();
    const std::optional<Memory::Entry> entry = std::exchange(memory().entry, std::nullopt);
    if (!entry)
      return;
    const Memory::Point end = pointOf(after, ctx.dialect());
    const CodeInfo *code = after.activeCode(ctx.dialect(), StandardGroup::Compensation);
    const bool whole = llvm::all_of(std::array{entry->from, entry->to, end}, [](const auto &point) {
      return point[0].isConstant() && point[1].isConstant();
    });
    if (!whole || !code || before.may(Fact::UnknownCode))
      return;
    if (throughContour(*entry, *code, event, ctx) || !mills_)
      return;
    const double dx = end[0].value() - entry->to[0].value(),
                 dy = end[1].value() - entry->to[1].value();
    if (dx == 0 && dy == 0)
      return; // down after the entry, which was made above the work
    const double ex = entry->from[0].value() - entry->to[0].value(),
                 ey = entry->from[1].value() - entry->to[1].value();
    const double left = dx * ey - dy * ex, along = dx * ex + dy * ey;
    constexpr double tolerance = 1e-3;
    const bool right = code->action == Action::CompensationRight;
    if (event.motion != MotionKind::Feed || along < -tolerance ||
        (right ? left <= tolerance : left >= -tolerance))
      return;
    const Origin &origin = after.origin.of(StatePart::Compensation);
    if (auto finding = ctx.report(causePlace(ctx, origin, entry->block).at, event.certain))
      finding
          .message("`{0}` keeps the tool {1} of the contour, and it comes from the other side: it "
                   "crosses the first element",
                   code->name, right ? "right" : "left")
          .note(ctx.blockRange(), "the first element");
  }

  bool mills_ = false; ///< how a mill comes to its first element is judged
};

} // namespace
NCVET_RULE(CompensationWrongSide, compensation_wrong_side)
} // namespace ncvet
