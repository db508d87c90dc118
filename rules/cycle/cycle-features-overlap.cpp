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

struct CycleFeaturesOverlapMemory {
  using Name = std::pair<AddressId, int64_t>;
  unsigned profiles = 0; ///< profiles of the pocket so far; the first one is its outline
  SourceRange begin;
  SourceRange pocketBegin;
  std::optional<Point> attach;
  Outline pocket;
  Outline current;
  ElementTable elements;
  std::optional<Name> startName;
  std::optional<ElementGeometry> circle; ///< of the current profile
};

class CycleFeaturesOverlap final : public StatefulRule<CycleFeaturesOverlapMemory> {
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

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion)
      return element(event, ctx);
    ctx.reportNotices(id, event);
    if (!pockets_)
      return;
    const Action action = ctx.code(event).action;
    if (action == Action::DefineElement)
      memory().elements.define(ctx);
    else if (action == Action::ProfileBegin || action == Action::ProfileRun)
      next(event, ctx);
  }

private:
  /// A profile that encloses something has a point from which the tool comes.
  static bool isClosed(const CodeInfo &code) {
    return code.action == Action::ProfileBegin &&
           llvm::any_of(code.words, [](const WordSpec &w) { return w.role == Role::Target; });
  }

  /// The profile before is complete; another one begins, or all of them are run.
  void next(const Event &event, RuleContext &ctx) const {
    if (memory().profiles == 1)
      memory().pocket = memory().current;
    else if (memory().profiles > 1)
      island(ctx);
    const bool begins = isClosed(ctx.code(event));
    memory().profiles = begins ? memory().profiles + 1 : 0;
    if (memory().profiles == 1)
      memory().pocketBegin = ctx.range(*event.word);
    memory().current.clear();
    memory().circle.reset();
    memory().startName.reset();
    memory().begin = ctx.range(*event.word);
    memory().attach = begins ? attachPoint(ctx.code(event), ctx) : std::nullopt;
  }

  void island(RuleContext &ctx) const {
    if (!memory().pocket.isClosed())
      return;
    const bool attach = memory().attach && memory().pocket.excludes(*memory().attach);
    const bool inside = memory().attach && memory().current.isClosed() &&
                        memory().current.encloses(*memory().attach);
    const bool contour =
        memory().current.isClosed() && memory().pocket.excludes(memory().current.first());
    if (!attach && !contour && !inside)
      return;
    if (auto finding = ctx.report(memory().begin))
      finding
          .message(attach    ? "the attach point of this island lies outside of the pocket"
                   : contour ? "this island lies outside of the pocket"
                             : "the attach point of this island lies in the island: the tool "
                               "would come down on what is to stay")
          .note(memory().pocketBegin, "the outline of the pocket");
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
  void element(const Event &event, RuleContext &ctx) const {
    const MachineState &before = ctx.before(), &after = ctx.after();
    if (!memory().profiles || before.profile != ProfileMode::Recorded ||
        ctx.find({Action::CompensationOff}))
      return;
    if (ctx.block().hasAny(ctx.dialect().cornerWords | ctx.dialect().lineAngleWords) ||
        !event.certain || before.may(Fact::UnknownCode))
      return memory().current.loseTrack();
    const bool attaches = before.compensation == phaseOff && after.compensation != phaseOff;
    if (const Word *name = ctx.block().findAny(ctx.dialect().elementWords))
      return named(*name, attaches);
    const std::array<Axis, 2> axes = planeOrder(ctx.dialect(), after);
    Point to;
    for (size_t i = 0; i < 2; ++i) {
      const Interval &at = after.at(axes[i]);
      if (!at.isConstant() || after.inMachineCoordinates(axes[i]))
        return memory().current.loseTrack();
      to[i] = at.value() / ctx.dialect().lengthsPerUnit(axes[i]);
    }
    if (attaches)
      return memory().current.start(to);
    if (!isArc(event.motion))
      return event.motion == MotionKind::Feed ? memory().current.line(to)
                                              : memory().current.loseTrack();
    const ArcGeometry arc = arcGeometry(arcWords(ctx.dialect(), after, ctx.block()), ctx.dialect(),
                                        ctx.machine(), ctx.block(), before, after);
    const auto centre =
        arc.radius && arc.start && arc.end
            ? centreByRadius(*arc.start, *arc.end, *arc.radius, event.motion == MotionKind::ArcCw)
            : arc.centre();
    if (!centre)
      return memory().current.loseTrack();
    memory().current.arc(*centre, to, event.motion == MotionKind::ArcCw);
  }

  /// Of elements by name only a circle between one point and the same is followed.
  void named(const Word &name, bool attaches) const {
    const auto key = std::pair(name.address, name.mantissa);
    const ElementGeometry *element = memory().elements.find(name);
    if (attaches && element && element->kind == ElementGeometry::Kind::Point) {
      memory().startName = key;
      return memory().current.start({element->x, element->y});
    }
    if (element && element->kind == ElementGeometry::Kind::Circle && memory().startName &&
        !memory().circle && memory().current.hasStart()) {
      memory().circle = *element;
      return;
    }
    const bool closes = memory().circle && memory().startName == key && memory().current.hasStart();
    if (!closes ||
        std::fabs(distance({memory().circle->x, memory().circle->y}, memory().current.first()) -
                  std::fabs(memory().circle->size)) > smallestOverlap)
      return memory().current.loseTrack();
    memory().current.arc({memory().circle->x, memory().circle->y}, memory().current.first(), false);
  }

  static constexpr llvm::StringLiteral id{"cycle-features-overlap"};
  bool pockets_ = false; ///< the control has pockets with islands
};

} // namespace
NCVET_RULE(CycleFeaturesOverlap, cycle_features_overlap)
} // namespace ncvet
