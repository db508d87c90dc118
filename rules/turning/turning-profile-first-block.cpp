// The first block of a profile has the wrong motion code or axes for the roughing cycle.
#include "analyzer/facts/profile_shape.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/program/references.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningProfileFirstBlock final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    codeRequired_ = to.dialect().facts->turning.firstBlockHasCode;
    startsInX_ = to.dialect().facts->turning.startsInX;
    faceXForbidden_ = to.dialect().facts->turning.faceStartsInZ;
    undercutNeedsZ_ = to.dialect().facts->turning.pocketsNeedZ;
    finish_ = to.dialect().facts->turning.finishNeedsLineFirst;
    bothAxesFirst_ = to.dialect().facts->turning.bothAxesFirst;
    mustMove_ = to.dialect().facts->turning.firstBlockMoves;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.outcome().flow.kind != FlowKind::Profile)
      return sleepInShape();
    const CodeInfo &cycle = ctx.code(event);
    const bool finishing = cycle.cycle == CycleKind::Finish;
    if (finishing && !finish_)
      return;
    if (!finishing && !ctx.dialect().profileRunsThrough)
      between(cycle, event, ctx);
    if (codeRequired_ && !finishing && isEmpty(cycle, event, ctx))
      return;
    for (const ProfileWay &way : profileWays(ctx))
      judge({event, cycle, way}, ctx);
  }

private:
  /// The control goes on after the profile: moves between the cycle and the profile are left out.
  static void between(const CodeInfo &cycle, const Event &event, RuleContext &ctx) {
    const int64_t first = ctx.outcome().flow.first;
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const auto place =
        resolveBlock(ctx.index(), program, Reference::toBlock(first), ctx.block().begin);
    constexpr unsigned furthest = 10; // blocks; a profile further off is not looked for here
    Block block = ctx.block();
    SourceRange lost;
    for (unsigned i = 0; place && i < furthest && readOn(ctx.index(), block); ++i) {
      if (block.begin >= *place || block.number == first)
        break;
      // With other work between them the profile is one of those that are kept apart.
      if (i + 1 == furthest || block.skip >= 0 || !block.items.empty() ||
          block.has(letterAddress('T')) ||
          findCode(ctx.dialect(), block,
                   {Action::Return, Action::ProgramEnd, Action::ProgramEndRewind}) ||
          block.has(letterAddress('P')))
        return;
      if (lost.empty() && (block.hasAny(ctx.dialect().axisWords | ctx.dialect().incrementWords) ||
                           findCode(ctx.dialect(), block,
                                    {Action::ReferenceReturn, Action::CompensationOff,
                                     Action::CompensationLeft, Action::CompensationRight})))
        lost = wordsRange(ctx, block);
    }
    if (lost.empty() || *place <= ctx.block().begin)
      return;
    if (auto finding = ctx.report(lost, event.certain))
      finding.severity(Severity::Warning)
          .message("this block between `{0}` and N{1}, where its profile begins, is never run: the "
                   "control goes on after the profile",
                   cycle.name, first)
          .note(ctx.blockRange(), "the cycle that works along the profile");
  }

  /// The number of the first block is in a line of its own.
  static bool isEmpty(const CodeInfo &cycle, const Event &event, RuleContext &ctx) {
    const ProgramInfo &program = ctx.index().programAt(ctx.block().begin);
    const auto place = resolveBlock(
        ctx.index(), program, Reference::toBlock(ctx.outcome().flow.first), ctx.block().begin);
    if (!place)
      return false;
    Block block;
    ctx.index().read(*place, block);
    if (!block.words.empty() || !block.items.empty())
      return false;
    if (auto finding =
            ctx.report(SourceRange{ctx.source().id(), block.begin, block.end}, event.certain))
      finding
          .message(
              "the first block of the profile of `{0}` is empty: the G00 or G01 move that leads "
              "to the contour belongs into it",
              cycle.name)
          .note(ctx.blockRange(), "the cycle that works along this profile");
    return true;
  }

  /// A cycle and one of the profiles along which it may work.
  struct Work {
    const Event &event;
    const CodeInfo &cycle;
    const ProfileWay &way;

    const ProfileBlock &first() const { return way.profile.blocks.front(); }
    bool moves(Axis axis) const { return first().axes >> unsigned(axis) & 1; }
    FindingBuilder report(RuleContext &ctx) const {
      FindingBuilder finding = ctx.report(first().range, event.certain && way.always);
      finding.note(ctx.blockRange(), "the cycle that works along this profile");
      way.explain(finding);
      return finding;
    }
  };

  void judge(const Work &work, RuleContext &ctx) const {
    if (!work.way.profile.known || !leadsIn(work, ctx))
      return;
    if (work.cycle.cycle == CycleKind::RoughFace)
      facing(work, ctx);
    else if (work.cycle.cycle == CycleKind::RoughTurn &&
             (startsInX_ || ctx.machine().option("roughType2") == llvm::StringRef("false")))
      turning(work, ctx);
    else if (work.cycle.cycle == CycleKind::RoughTurn)
      pockets(work, ctx);
  }

  /// Whether the first block is a move along a line, as the cycle needs it; reports when not.
  bool leadsIn(const Work &work, RuleContext &ctx) const {
    const ProfileBlock &first = work.first();
    const bool stated = llvm::any_of(
        first.codes, [&](const CodeUse &use) { return isMotion(ctx.code(use).action); });
    const bool linear = !first.moves || !first.motionKnown || first.motion == MotionKind::Rapid ||
                        first.motion == MotionKind::Feed;
    const bool finishing = work.cycle.cycle == CycleKind::Finish;
    if (!linear || (codeRequired_ && !stated && !finishing)) {
      if (auto finding = work.report(ctx))
        finding.message(
            linear ? "the first block of the profile of `{0}` needs a G00 or G01 of its own: "
                     "it decides how the tool feeds in"
                   : "the profile of `{0}` begins with an arc: its first block is a G00 or "
                     "G01 move",
            work.cycle.name);
      return false;
    }
    if (mustMove_ && !first.moves && !first.block.hasAny(ctx.dialect().axisWords)) {
      if (auto finding = work.report(ctx))
        finding.message("the first block of the profile of `{0}` does not move: it is the G00 or "
                        "G01 move that leads to the contour",
                        work.cycle.name);
      return false;
    }
    return true;
  }

  void facing(const Work &work, RuleContext &ctx) const {
    if (faceXForbidden_ && work.moves(Axis::X))
      if (auto finding = work.report(ctx))
        finding.message("the first block of the profile of `{0}` moves in X: it may move in Z only",
                        work.cycle.name);
  }

  static void turning(const Work &work, RuleContext &ctx) {
    if (work.moves(Axis::Z))
      if (auto finding = work.report(ctx))
        finding.message("the first block of the profile of `{0}` moves in Z: it may move in X only",
                        work.cycle.name);
  }

  /// The axes of the first block select the type of roughing that works out pockets.
  void pockets(const Work &work, RuleContext &ctx) const {
    const Profile &profile = work.way.profile;
    const bool hasX = work.moves(Axis::X), hasZ = work.moves(Axis::Z);
    const ShapeBreak undercut = undercutOf(ctx, profile);
    // Where the tool is at that Z already the word says nothing else.
    const Interval &from = work.first().fromZ, &to = work.first().toZ;
    if (hasZ && !hasX && leadsAlong(work, ctx))
      return;
    const bool stays = from.isConstant() && from == to;
    if (!bothAxesFirst_ && hasX && hasZ && (!stays || ctx.asked()) && !undercut.found &&
        undercut.decided && work.way.always) {
      if (auto finding = work.report(ctx))
        finding
            .message(
                "the first block of the profile of `{0}` has X and Z, which selects the type for "
                "pockets, but the contour has none",
                work.cycle.name)
            .severity(Severity::Style);
    } else if (undercutNeedsZ_ && hasX && !hasZ && undercut.found) {
      if (auto finding = work.report(ctx))
        finding
            .message(
                "the contour of `{0}` has a pocket, and its first block has no Z word, which would "
                "select the type for pockets",
                work.cycle.name)
            .note(profile.blocks[undercut.index].range, "the contour turns back here");
    }
  }

  /// A first block in Z alone that goes along the work: no block leads in to the contour.
  static bool leadsAlong(const Work &work, RuleContext &ctx) {
    const ProfileBlock &first = work.first();
    if (!first.motionKnown || first.motion != MotionKind::Feed || !first.fromZ.isConstant() ||
        !first.toZ.isConstant() || first.toZ.value() >= first.fromZ.value() ||
        first.toZ.value() >= 0 || !work.event.certain)
      return false;
    if (auto finding = work.report(ctx))
      finding.severity(Severity::Warning)
          .message(
              "the first block of the profile of `{0}` moves along Z alone: it is the one that "
              "leads in X to the contour, and nothing is left to rough",
              work.cycle.name);
    return true;
  }

  bool codeRequired_ = false, startsInX_ = false, faceXForbidden_ = false, undercutNeedsZ_ = false;
  bool finish_ = false;        ///< a finishing cycle asks the same of its first block
  bool bothAxesFirst_ = false; ///< both axes are allowed for any contour
  bool mustMove_ = false;      ///< the first block has to move
};

} // namespace
NCVET_RULE(TurningProfileFirstBlock, turning_profile_first_block)
} // namespace ncvet
