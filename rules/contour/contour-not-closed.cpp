// The contour of a pocket or island that does not end where it begins, and a compensated contour
// that ends just beside it.
#include "analyzer/rule/rule.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/tool_data.h"
#include "interp/geometry/direction.h"

namespace ncvet {
namespace {

/// A contour as the polygon of its points.
class ContourPoints {
public:
  void begin(const Point &at) { points_.assign(1, at); }
  void clear() { points_.clear(); }
  bool known() const { return !points_.empty(); }
  const auto &remembered() const { return points_; }
  void add(const Point &at) {
    if (points_.size() >= most)
      return clear();
    if (distance(points_.back(), at) > same)
      points_.push_back(at);
  }
  /// Distance between the ends of a contour that neither comes back to its first element nor runs
  /// across it; none of one that does, or that is a line.
  std::optional<double> gap() const {
    if (points_.size() < 4)
      return std::nullopt;
    const Point &a = points_[0], &b = points_[1];
    for (size_t i = 2; i + 1 < points_.size(); ++i) {
      const Point &c = points_[i], &d = points_[i + 1];
      if (reaches(c, d, a) || reaches(c, d, b) || crosses(a, b, c, d))
        return std::nullopt;
    }
    return distance(a, points_.back());
  }
  /// What the last element lacks to reach the first one, where the contour has gone once round and
  /// its last element leads there; none where more is missing than was made of it.
  std::optional<double> missing() const {
    if (!gap())
      return std::nullopt;
    double turned = 0;
    for (size_t i = 1; i + 1 < points_.size(); ++i)
      turned += turn(points_[i - 1], points_[i], points_[i + 1]);
    constexpr double about = 0.02; // rad
    if (std::fabs(turned) < 0.75 * fullTurn - about || std::fabs(turned) > fullTurn + about)
      return std::nullopt;
    const Point &a = points_[0], &b = points_[1];
    const Point &p = points_[points_.size() - 2], &q = points_.back();
    const double ofFirst = side(a, b, q) - side(a, b, p);
    if (std::fabs(ofFirst) < same)
      return std::nullopt;                         // they run parallel
    const double along = -side(a, b, p) / ofFirst; // 1: at the end of the last element
    const Point meets = p + (q - p) * along;
    if (along <= 1 || along >= 2 || !reaches(a, b, meets))
      return std::nullopt;
    return (along - 1) * distance(p, q);
  }

private:
  /// From the line `a` `b` to the line `b` `c`, in radians, positive to the left.
  static double turn(const Point &a, const Point &b, const Point &c) {
    return angleBetween(b - a, c - b);
  }

  static constexpr double same = 0.001; // mm
  static constexpr size_t most = 500;   // points, beyond which nothing is said

  /// Positive when `p` lies left of the line from `a` to `b`.
  static double side(const Point &a, const Point &b, const Point &p) { return cross(b - a, p - a); }
  static bool reaches(const Point &c, const Point &d, const Point &p) {
    const double length = distance(c, d);
    const double along = (d - c).dot(p - c) / length;
    return std::fabs(side(c, d, p)) / length <= same && along >= -same && along <= length + same;
  }
  static bool crosses(const Point &a, const Point &b, const Point &c, const Point &d) {
    return side(a, b, c) * side(a, b, d) < 0 && side(c, d, a) * side(c, d, b) < 0;
  }

  std::vector<Point> points_;
};

struct ContourNotClosedMemory {
  ContourPoints outline;
  SourceRange last;    ///< the block with the contour's last element
  bool closed = false; ///< such a profile is being recorded
  SourceRange begin;   ///< the block that attaches; empty: none yet
  std::array<Interval, axisCount> start;
  std::optional<Point> corner; ///< at which the outline of a cycle begins
};

class ContourNotClosed final : public StatefulRule<ContourNotClosedMemory> {
public:
  void listen(Subscriptions &to) override {
    bool wanted = false;
    for (const CodeInfo &code : to.dialect().codes)
      wanted |= isClosed(code);
    usual_ = to.number("gap", 0);
    round_ = to.dialect().facts->compensation.contourMeetsStart;
    outline_ = to.dialect().facts->cycles.outlineMoves;
    if (outline_)
      to.on({EventKind::Motion, EventKind::Return});
    if (!wanted && usual_ <= 0 && !round_)
      return;
    to.onAction({Action::ProfileBegin, Action::ProfileRun, Action::CompensationOff});
    to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (outline_ && ctx.before().must(Fact::InContour))
      return atOutline(event, ctx);
    if (event.kind == EventKind::Return)
      return;
    if (usual_ > 0 || round_)
      follow(event, ctx);
    if (event.kind == EventKind::Motion) {
      if (memory().closed && ctx.before().profile == ProfileMode::Recorded &&
          ctx.before().compensation == phaseOff && ctx.after().compensation != phaseOff) {
        memory().start = ctx.after().position;
        memory().begin = ctx.blockRange();
      }
      if ((ctx.before().compensation | ctx.after().compensation) == phaseOff)
        sleepInStretch();
      return;
    }
    if (ctx.code(event).action != Action::CompensationOff) {
      memory().closed = isClosed(ctx.code(event));
      memory().begin = {};
      return;
    }
    if (!memory().closed || !memory().begin.end || ctx.before().profile != ProfileMode::Recorded)
      return;
    const uint16_t plane = planeAxes(ctx.dialect(), ctx.after());
    bool apart = false;
    for (unsigned axis = 0; axis < axisCount; ++axis) {
      const Interval &first = memory().start[axis], &last = ctx.before().position[axis];
      if (!(plane >> axis & 1))
        continue;
      if (!first.isConstant() || !last.isConstant())
        return;
      apart |= first.value() != last.value();
    }
    const SourceRange begin = memory().begin;
    memory().begin = {};
    if (!apart)
      return;
    if (auto finding = ctx.report(begin))
      finding.message("this contour does not end where it begins: it encloses nothing")
          .note(ctx.blockRange(), "it ends before this block");
  }

private:
  /// A profile that encloses something has a point from which the tool comes.
  static bool isClosed(const CodeInfo &code) {
    return code.action == Action::ProfileBegin &&
           llvm::any_of(code.words, [](const WordSpec &w) { return w.role == Role::Target; });
  }

  /// The compensated contour, from where the tool engages to where it leaves.
  void follow(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (before.compensation != phaseOn) {
      memory().outline.clear();
      if (const auto at = place(ctx); at && after.compensation == phaseOn)
        memory().outline.begin(*at);
      return;
    }
    if (!memory().outline.known())
      return;
    if (after.compensation != phaseOn) {
      nearlyClosed(ctx);
      memory().outline.clear();
      return;
    }
    const auto at = place(ctx);
    const bool line = event.kind == EventKind::Motion && event.motion == MotionKind::Feed;
    // What lies between the ends of an arc is not looked at.
    if (!at || (event.kind == EventKind::Motion && !line))
      return memory().outline.clear();
    memory().outline.add(*at);
    if (event.axes & planeAxes(ctx.dialect(), after))
      memory().last = ctx.blockRange();
  }

  /// Position in the plane; none where it is not known.
  static std::optional<Point> place(const RuleContext &ctx) {
    const auto axes = planeOrder(ctx.dialect(), ctx.after());
    Point result = Point::Zero();
    for (size_t i = 0; i < 2; ++i) {
      const Interval &at = ctx.after().at(axes[i]);
      if (!at.isConstant() || ctx.after().inMachineCoordinates(axes[i]))
        return std::nullopt;
      result[i] = at.value() / ctx.dialect().lengthsPerUnit(axes[i]);
    }
    return result;
  }

  void nearlyClosed(RuleContext &ctx) const {
    if (const auto missing = round_ ? memory().outline.missing() : std::nullopt) {
      if (auto finding = ctx.report(memory().last))
        finding.severity(Severity::Warning)
            .message("this contour ends {0:f3} mm before its first element: material "
                     "remains there",
                     *missing);
      return;
    }
    if (usual_ <= 0)
      return;
    const auto gap = memory().outline.gap();
    const ToolData *tool = compensatingTool(ctx.dialect(), ctx.machine(), ctx.before());
    const double radius = tool && tool->radius ? *tool->radius : usual_;
    if (!gap || *gap >= radius)
      return;
    if (auto finding = ctx.report(memory().last))
      finding.severity(Severity::Warning)
          .message(
              "this contour ends {0:f3} mm beside the point where it begins: a step stays there",
              *gap);
  }

  /// The program that a cycle reads as the outline of a pocket.
  void atOutline(const Event &event, RuleContext &ctx) const {
    if (event.kind == EventKind::Motion) {
      if (!ctx.before().may(Fact::ContourBegun))
        memory().corner = place(ctx);
      memory().last = ctx.blockRange();
      return;
    }
    const auto end = event.kind == EventKind::Return ? place(ctx) : std::nullopt;
    constexpr double same = 0.01; // mm
    if (!end || !memory().corner || distance(*end, *memory().corner) <= same)
      return;
    if (auto finding = ctx.report(memory().last))
      finding.severity(Severity::Warning)
          .message(
              "this outline ends {0:f3} mm from the corner where it begins: it encloses nothing",
              distance(*end, *memory().corner));
    memory().corner.reset();
  }

  bool outline_ = false; ///< the contours that cycles read are closed outlines
  bool round_ = false;   ///< a contour that has gone round is to reach its first element
  double usual_ = 0;     ///< mm that a gap may have where the tool is not known; 0: not looked at
};

} // namespace
NCVET_RULE(ContourNotClosed, contour_not_closed)
} // namespace ncvet
