// Slots or holes of one call run into each other, an island lies outside of its pocket.
#include "analyzer/facts/element_geometry.h"
#include "analyzer/facts/lookahead.h"
#include "analyzer/facts/outline.h"
#include "interp/evaluate/expression.h"
#include "interp/path/arc_block.h"

#include <cmath>

namespace ncvet {
namespace {

/// What lies nearer to a circle than this lies on it, millimetres.
constexpr double smallestOverlap = 0.01;

class CycleFeaturesOverlap final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    for (const CodeInfo &code : to.dialect().codes)
      pockets_ |= isClosed(code);
    if (!pockets_)
      return;
    to.onAction({Action::ProfileBegin, Action::ProfileRun, Action::DefineElement});
    to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Motion)
      return element(event, ctx);
    ctx.reportNotices(id, event);
    if (!pockets_)
      return;
    const Action action = ctx.code(event).action;
    if (action == Action::DefineElement)
      elements_.define(ctx);
    else if (action == Action::ProfileBegin || action == Action::ProfileRun)
      next(event, ctx);
  }
  void remember(RuleMemory &memory) const override {
    memory(profiles_, begin_, pocketBegin_, attach_, pocket_, current_, elements_, startName_,
           circle_);
  }

private:
  /// A profile that encloses something has a point from which the tool comes.
  static bool isClosed(const CodeInfo &code) {
    return code.action == Action::ProfileBegin &&
           llvm::any_of(code.words, [](const WordSpec &w) { return w.role == Role::Target; });
  }

  /// The profile before is complete; another one begins, or all of them are run.
  void next(const Event &event, RuleContext &ctx) {
    if (profiles_ == 1)
      pocket_ = current_;
    else if (profiles_ > 1)
      island(ctx);
    const bool begins = isClosed(ctx.code(event));
    profiles_ = begins ? profiles_ + 1 : 0;
    if (profiles_ == 1)
      pocketBegin_ = ctx.range(*event.word);
    current_.clear();
    circle_.reset();
    startName_.reset();
    begin_ = ctx.range(*event.word);
    attach_ = begins ? attachPoint(ctx.code(event), ctx) : std::nullopt;
  }

  void island(RuleContext &ctx) const {
    if (!pocket_.isClosed())
      return;
    const bool attach = attach_ && pocket_.excludes(*attach_);
    const bool inside = attach_ && current_.isClosed() && current_.encloses(*attach_);
    const bool contour = current_.isClosed() && pocket_.excludes(current_.first());
    if (!attach && !contour && !inside)
      return;
    if (auto finding = ctx.report(begin_))
      finding
          .message(attach    ? "the attach point of this island lies outside of the pocket"
                   : contour ? "this island lies outside of the pocket"
                             : "the attach point of this island lies in the island: the tool "
                               "would come down on what is to stay")
          .note(pocketBegin_, "the outline of the pocket");
  }

  /// The first two variables of the code: its place in the plane.
  static std::optional<Point> attachPoint(const CodeInfo &code, const RuleContext &ctx) {
    Point place;
    size_t found = 0;
    for (const WordSpec &spec : code.words)
      if (spec.variable && found < 2) {
        const Value value = readVariable(ctx.after(), int64_t(givenVariable(spec, ctx.after())));
        const auto unit = millimetresPer(ctx.dialect(), ctx.after());
        if (!value.isConstant() || !unit)
          return std::nullopt;
        place[found++] = value.number.value() * *unit;
      }
    return found == 2 ? std::optional(place) : std::nullopt;
  }

  /// A piece of the profile that is being recorded.
  void element(const Event &event, RuleContext &ctx) {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (!profiles_ || before.profile != 1 || ctx.find({Action::CompensationOff}))
      return;
    if (ctx.block().hasAny(ctx.dialect().cornerWords | ctx.dialect().lineAngleWords) ||
        !event.certain || before.may(Fact::UnknownCode))
      return current_.loseTrack();
    const bool attaches = before.compensation == phaseOff && after.compensation != phaseOff;
    if (const Word *name = ctx.block().findAny(ctx.dialect().elementWords))
      return named(*name, attaches);
    const std::array<Axis, 2> axes = planeOrder(ctx.dialect(), after);
    Point to;
    for (size_t i = 0; i < 2; ++i) {
      const Interval &at = after.at(axes[i]);
      if (!at.isConstant() || after.inMachineCoordinates(axes[i]))
        return current_.loseTrack();
      to[i] = at.value() / ctx.dialect().lengthsPerUnit(axes[i]);
    }
    if (attaches)
      return current_.start(to);
    if (event.motion != MotionKind::ArcCw && event.motion != MotionKind::ArcCcw)
      return event.motion == MotionKind::Feed ? current_.line(to) : current_.loseTrack();
    const ArcGeometry arc = arcGeometry(arcWords(ctx.dialect(), after, ctx.block()), ctx.dialect(),
                                        ctx.machine(), ctx.block(), before, after);
    const auto centre =
        arc.radius && arc.start && arc.end
            ? centreByRadius(*arc.start, *arc.end, *arc.radius, event.motion == MotionKind::ArcCw)
            : arc.centre();
    if (!centre)
      return current_.loseTrack();
    current_.arc(*centre, to, event.motion == MotionKind::ArcCw);
  }

  /// Of elements by name only a circle between one point and the same is followed.
  void named(const Word &name, bool attaches) {
    const auto key = std::pair(name.address, name.mantissa);
    const ElementGeometry *element = elements_.find(name);
    if (attaches && element && element->kind == ElementGeometry::Kind::Point) {
      startName_ = key;
      return current_.start({element->x, element->y});
    }
    if (element && element->kind == ElementGeometry::Kind::Circle && startName_ && !circle_ &&
        current_.hasStart()) {
      circle_ = *element;
      return;
    }
    const bool closes = circle_ && startName_ == key && current_.hasStart();
    if (!closes || std::fabs(distance({circle_->x, circle_->y}, current_.first()) -
                             std::fabs(circle_->size)) > smallestOverlap)
      return current_.loseTrack();
    current_.arc({circle_->x, circle_->y}, current_.first(), false);
  }

  static constexpr llvm::StringLiteral id{"cycle-features-overlap"};
  bool pockets_ = false;  ///< the control has pockets with islands
  unsigned profiles_ = 0; ///< profiles of the pocket so far; the first one is its outline
  SourceRange begin_, pocketBegin_;
  std::optional<Point> attach_;
  Outline pocket_, current_;
  using Name = std::pair<AddressId, int64_t>;
  ElementTable elements_;
  std::optional<Name> startName_;
  std::optional<ElementGeometry> circle_; ///< of the profile at hand
};

} // namespace
NCVET_RULE(CycleFeaturesOverlap, cycle_features_overlap)
} // namespace ncvet
