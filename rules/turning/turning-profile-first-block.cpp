// The first block of a profile has the wrong motion code or axes for the roughing cycle.
#include "analyzer/facts/profile_shape.h"
#include "analyzer/facts/turning_profile.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningProfileFirstBlock final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    codeRequired_ = to.dialect().facts->turning.firstBlockHasCode;
    zForbidden_ = to.dialect().facts->turning.startsInX;
    faceXForbidden_ = to.dialect().facts->turning.faceStartsInZ;
    undercutNeedsZ_ = to.dialect().facts->turning.pocketsNeedZ;
    finish_ = to.dialect().facts->turning.finishNeedsLineFirst;
    mustMove_ = to.dialect().facts->turning.firstBlockMoves;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.outcome().flow.kind != FlowKind::Profile)
      return;
    const CodeInfo &cycle = ctx.code(event);
    const bool finishing = cycle.cycle == CycleKind::Finish;
    if (finishing && !finish_)
      return;
    for (const ProfileWay &way : profileWays(ctx))
      judge(event, cycle, way, ctx);
  }

private:
  void judge(const Event &event, const CodeInfo &cycle, const ProfileWay &way,
             RuleContext &ctx) const {
    const Profile &profile = way.profile;
    if (!profile.known)
      return;
    const bool finishing = cycle.cycle == CycleKind::Finish;
    const ProfileBlock &first = profile.blocks.front();
    const auto report = [&](bool certain = true) {
      FindingBuilder finding = ctx.report(first.range, certain && event.certain && way.always);
      finding.note(ctx.blockRange(), "the cycle that works along this profile");
      way.explain(finding);
      return finding;
    };
    bool stated = false;
    for (const CodeUse &use : first.codes)
      stated |= isMotion(ctx.code(use).action);
    const bool linear = !first.moves || !first.motionKnown || first.motion == MotionKind::Rapid ||
                        first.motion == MotionKind::Feed;
    if (!linear || (codeRequired_ && !stated && !finishing)) {
      if (auto finding = report())
        finding.message(
            linear ? "the first block of the profile of `{0}` needs a G00 or G01 of its own: "
                     "it decides how the tool feeds in"
                   : "the profile of `{0}` begins with an arc: its first block is a G00 or "
                     "G01 move",
            cycle.name);
      return;
    }
    if (mustMove_ && !first.moves && !first.block.hasAny(ctx.dialect().axisWords)) {
      if (auto finding = report())
        finding.message("the first block of the profile of `{0}` does not move: it is the G00 or "
                        "G01 move that leads to the contour",
                        cycle.name);
      return;
    }
    if (finishing)
      return;
    const bool hasX = first.axes >> unsigned(Axis::X) & 1;
    const bool hasZ = first.axes >> unsigned(Axis::Z) & 1;
    if (cycle.cycle == CycleKind::RoughFace) {
      if (faceXForbidden_ && hasX)
        if (auto finding = report())
          finding.message(
              "the first block of the profile of `{0}` moves in X: it may move in Z only",
              cycle.name);
      return;
    }
    if (cycle.cycle != CycleKind::RoughTurn)
      return;
    if (zForbidden_) {
      if (hasZ)
        if (auto finding = report())
          finding.message(
              "the first block of the profile of `{0}` moves in Z: it may move in X only",
              cycle.name);
      return;
    }
    const ShapeBreak undercut = undercutOf(ctx, profile);
    if (hasX && hasZ && !undercut.found && undercut.decided && way.always) {
      if (auto finding = report())
        finding
            .message(
                "the first block of the profile of `{0}` has X and Z, which selects the type for "
                "pockets, but the contour has none",
                cycle.name)
            .severity(Severity::Style);
    } else if (undercutNeedsZ_ && hasX && !hasZ && undercut.found) {
      if (auto finding = report())
        finding
            .message(
                "the contour of `{0}` has a pocket, and its first block has no Z word, which would "
                "select the type for pockets",
                cycle.name)
            .note(profile.blocks[undercut.index].range, "the contour turns back here");
    }
  }

  bool codeRequired_ = false, zForbidden_ = false, faceXForbidden_ = false, undercutNeedsZ_ = false;
  bool finish_ = false;   ///< a finishing cycle asks the same of its first block
  bool mustMove_ = false; ///< the first block has to move
};

} // namespace
NCVET_RULE(TurningProfileFirstBlock, turning_profile_first_block)
} // namespace ncvet
