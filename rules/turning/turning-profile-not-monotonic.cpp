// A profile turns back where its roughing cycle needs a steadily rising or falling contour.
#include "analyzer/facts/profile_shape.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/measure.h"

namespace ncvet {
namespace {

class TurningProfileNotMonotonic final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    maxPockets_ = to.number("maxPockets", 10);
    zSelectsType_ = to.flag("zSelectsType", true);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &cycle = ctx.code(event);
    if (ctx.outcome().flow.kind == FlowKind::Contour && has(cycle, CycleTrait::Turned))
      return passes(event, cycle, ctx);
    if (ctx.outcome().flow.kind != FlowKind::Profile)
      return sleepInShape();
    if (cycle.cycle != CycleKind::RoughTurn && cycle.cycle != CycleKind::RoughFace)
      return;
    for (const ProfileWay &way : profileWays(ctx))
      judge(event, cycle, way, ctx);
  }

private:
  void judge(const Event &event, const CodeInfo &cycle, const ProfileWay &way,
             RuleContext &ctx) const {
    const Profile &profile = way.profile;
    if (!profile.known || profile.blocks.size() < 2)
      return;
    const ProfileBlock &first = profile.blocks.front();
    const bool both =
        (first.axes >> unsigned(Axis::X) & 1) && (first.axes >> unsigned(Axis::Z) & 1);
    const bool pocketType = both && zSelectsType_;
    const bool face = cycle.cycle == CycleKind::RoughFace;
    Profile shape = profile;
    if (face)
      shape.side = Side::Unknown;
    const ShapeBreak x = undercutOf(ctx, shape);
    const ShapeBreak z = returnInZ(ctx, profile);
    // The axis along which the passes run must be steady in every type.
    const ShapeBreak &along = face ? x : z;
    const ShapeBreak &across = face ? z : x;
    if (along.decided && along.found)
      report(event, cycle, profile.blocks[along.index], face ? 'X' : 'Z', way, ctx);
    if (!across.decided || !across.found)
      return;
    if (!pocketType) {
      report(event, cycle, profile.blocks[across.index], face ? 'Z' : 'X', way, ctx);
    } else if (across.pockets > maxPockets_) {
      if (auto finding = ctx.report(event, event.certain && way.always)) {
        finding.message("the profile of `{0}` has {1} pockets, the cycle takes {2}", cycle.name,
                        across.pockets, maxPockets_);
        way.explain(finding);
      }
    }
  }

  /// Passes that cut at levels need a contour that is steady along these.
  static void passes(const Event &event, const CodeInfo &cycle, RuleContext &ctx) {
    if (!formulaOf(cycle, Measure::Step)) // finishing
      return;
    Profile profile = readProfile(ctx);
    profile.side = Side::Unknown;
    constexpr double borne = 0.03; // mm: the interpreter's thousandth of an inch
    const bool across = formulaOf(cycle, Measure::Across) != nullptr;
    const ShapeBreak along =
        across ? undercutOf(ctx, profile, borne) : returnInZ(ctx, profile, borne);
    if (!along.decided || !along.found)
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("`{0}` stops: its contour turns back in {1}, along which it cuts", cycle.name,
                   across ? "X" : "Z")
          .note(profile.blocks[along.index].range, "it turns back here");
  }

  static void report(const Event &event, const CodeInfo &cycle, const ProfileBlock &block,
                     char axis, const ProfileWay &way, RuleContext &ctx) {
    if (auto finding = ctx.report(block.range, event.certain && way.always)) {
      finding
          .message(
              "the profile of `{0}` turns back in {1} here, but this type of roughing needs it "
              "steadily rising or falling",
              cycle.name, axis)
          .note(ctx.blockRange(), "the cycle that works along this profile");
      way.explain(finding);
    }
  }

  double maxPockets_ = 10;
  bool zSelectsType_ = true;
};

} // namespace
NCVET_RULE(TurningProfileNotMonotonic, turning_profile_not_monotonic)
} // namespace ncvet
