// A tool is fed down into material.
#include "analyzer/facts/lookahead.h"
#include "analyzer/rule/gathering_rule.h"
#include "formats/dialect/measure.h"
#include "interp/geometry/point.h"

#include <cmath>

namespace ncvet {
namespace {

using PlaceInPlane = std::array<Interval, 2>;

/// The holes that were made. Runs that add to them are told apart by what they add.
class HolesMade {
public:
  void add(const PlaceInPlane &place) {
    if (!place[0].isConstant() || !place[1].isConstant() ||
        made_.holes.items().size() >= mostHoles) {
      made_.anywhere = true;
      return;
    }
    made_.holes.add({place[0].value(), place[1].value()});
  }
  /// One of them may be anywhere.
  bool isAnywhere() const { return made_.anywhere; }
  bool isMade(double x, double y) const {
    constexpr double near = 0.01; // mm
    return llvm::any_of(made_.holes.items(), [&](const std::array<double, 2> &hole) {
      return distance({hole[0], hole[1]}, {x, y}) < near;
    });
  }
  const auto &remembered() const { return made_; }

private:
  /// Holes beyond so many are not told apart any more.
  static constexpr size_t mostHoles = 4096;

  struct Made {
    SummedList<std::array<double, 2>> holes;
    bool anywhere = false; ///< a hole was made at a place that is not known
  };
  Made made_;
};

struct CyclePlungeIntoSolidMemory {
  Aside<HolesMade> holes;
};

class CyclePlungeIntoSolid final : public GatheringRule<CyclePlungeIntoSolidMemory, PlaceInPlane> {
public:
  void listen(Subscriptions &to) override {
    to.onNotices(id);
    wantsHoles_ = llvm::any_of(
        to.dialect().codes, [](const CodeInfo &code) { return has(code, CycleTrait::WantsHole); });
    if (!wantsHoles_)
      return;
    to.gathers();
    to.on(EventKind::CycleRun);
    to.onChange({EventKind::Motion}); // further feeds along that axis are at the same place
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Code)
      return ctx.reportNotices(id, event);
    if (event.kind == EventKind::Motion)
      return madeByHand(event, ctx);
    if (event.kind != EventKind::CycleRun || event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    if (has(code, CycleTrait::WantsHole))
      return wanted(event, ctx);
    if (makesHole(code.cycle) || code.cycle == CycleKind::Pocket ||
        code.cycle == CycleKind::Pattern)
      for (const Place &place : ctx.outcome().holes)
        made(inPlane(place, ctx));
  }

private:
  bool takeOver(llvm::ArrayRef<PlaceInPlane> holes) const override {
    for (const PlaceInPlane &place : holes)
      memory().holes.note().add(place);
    return true;
  }

  static constexpr llvm::StringLiteral id{"cycle-plunge-into-solid"};
  using Place = std::array<Interval, axisCount>;

  static PlaceInPlane inPlane(const Place &place, RuleContext &ctx) {
    const auto axes = planeOrder(ctx.dialect(), ctx.after());
    return {place[size_t(axes[0])], place[size_t(axes[1])]};
  }

  void made(const PlaceInPlane &place) const {
    note(place);
    memory().holes.note().add(place);
  }

  /// A feed along the tool's axis alone.
  void madeByHand(const Event &event, RuleContext &ctx) const {
    const Axis tool = toolAxis(ctx.dialect(), ctx.after());
    if (event.motion == MotionKind::Feed && event.axes == uint16_t(1u << unsigned(tool)))
      made(inPlane(ctx.after().position, ctx));
  }

  void wanted(const Event &event, RuleContext &ctx) const {
    const HolesMade &holes = memory().holes.look();
    const MachineState &state = ctx.after();
    const auto [x, y] = inPlane(state.position, ctx);
    if (holes.isAnywhere() || !x.isConstant() || !y.isConstant() || state.transforms[0] ||
        state.may(Fact::UnknownCode) || ctx.callDepth() > 0 || holes.isMade(x.value(), y.value()))
      return;
    if (auto finding = ctx.report(event, /*certain=*/false))
      finding.message(
          "`{0}` goes straight down and wants a hole there: this program has drilled none",
          ctx.code(event).name);
  }

  bool wantsHoles_ = false; ///< the control has cycles that go down into a hole
};

} // namespace
NCVET_RULE(CyclePlungeIntoSolid, cycle_plunge_into_solid)
} // namespace ncvet
