// A turned contour with slants or arcs and no compensation, or compensation around a contour cycle.
#include "analyzer/facts/cause_place.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/rule/report_once.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/tool_data.h"

namespace ncvet {
namespace {

struct CompensationMissingOnContourMemory {
  FileId contourFile = 0;
  uint32_t contourEnd = ~0u;
  bool reported = false;
  OncePerCause once;
};

class CompensationMissingOnContour final : public StatefulRule<CompensationMissingOnContourMemory> {
public:
  void listen(Subscriptions &to) override {
    if (to.dialect().isLathe())
      to.on({EventKind::Motion, EventKind::CycleRun});
    ends_ = to.dialect().facts->compensation.atEndsOfProfile;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::CycleRun) {
      atCycle(event, ctx);
      if (ends_)
        inside(event, ctx);
    } else
      atMotion(event, ctx);
  }

private:
  void atMotion(const Event &event, RuleContext &ctx) const {
    const bool cuts = isFeed(event.motion);
    if (!cuts || event.code == noCode || ctx.after().profile == ProfileMode::Recorded)
      return;
    // One finding for each contour: a run of blocks that cut.
    const bool goesOn =
        ctx.source().id() == memory().contourFile && ctx.block().begin == memory().contourEnd;
    const bool known = goesOn && memory().reported;
    // The move that cancels compensation leaves the contour: what follows is another one.
    const bool leaves = ctx.before().compensation != phaseOff;
    memory().contourFile = ctx.source().id();
    memory().contourEnd =
        leaves && ctx.after().compensation == phaseOff ? noBlock : ctx.block().next;
    memory().reported = known;
    const Axis x = Axis::X, z = Axis::Z;
    const uint16_t plane = uint16_t(1u << unsigned(x) | 1u << unsigned(z));
    if (planeAxes(ctx.dialect(), ctx.after()) != plane || ctx.after().compensation != phaseOff ||
        leaves || !goesOn || known)
      return;
    if (const ToolData *tool = toolInUse(ctx.machine(), ctx.after()))
      if (tool->kind != "turning" && tool->kind != "boring" && !tool->kind.empty())
        return;
    bool slanted = event.motion != MotionKind::Feed;
    if (!slanted) {
      const Interval dx = ctx.after().at(x) - ctx.before().at(x);
      const Interval dz = ctx.after().at(z) - ctx.before().at(z);
      slanted = (dx.lo > 0 || dx.hi < 0) && (dz.lo > 0 || dz.hi < 0) &&
                !ctx.before().inMachineCoordinates(x) && !ctx.before().inMachineCoordinates(z);
    }
    if (!slanted)
      return;
    memory().reported = true;
    if (auto finding = ctx.report(ctx.blockRange(), event.certain))
      finding.message("this contour has slants or arcs and is cut without `G41` or `G42`: it comes "
                      "out wrong by the nose radius");
  }

  void atCycle(const Event &event, RuleContext &ctx) const {
    if (ctx.outcome().flow.kind != FlowKind::Profile || event.code == noCode ||
        ctx.before().compensationActive(ctx.dialect()) != Truth::Yes)
      return;
    const Origin &origin = ctx.before().origin.of(StatePart::Compensation);
    if (!origin.known())
      return;
    const CausePlace place = causePlace(ctx, origin);
    if (!place.isCause && !memory().once.speaks(origin, ctx))
      return;
    if (auto finding = ctx.report(place.at, event.certain))
      finding
          .message("compensation is on around the contour cycle `{0}`: it belongs into the "
                   "contour, on in its first block and off in its last",
                   ctx.code(event).name)
          .note(place.other, place.note("the cycle is called here", "it is switched on here"));
  }

  /// Compensation belongs on in the first block of the contour and off in its last.
  static void inside(const Event &event, RuleContext &ctx) {
    if (ctx.outcome().flow.kind != FlowKind::Profile || event.code == noCode ||
        ctx.code(event).cycle == CycleKind::Finish)
      return;
    const Profile profile = readProfile(ctx);
    if (!profile.known)
      return;
    for (const ProfileBlock &entry : profile.blocks)
      for (const CodeUse &use : entry.codes) {
        const Action action = ctx.code(use).action;
        const bool on = action == Action::CompensationLeft || action == Action::CompensationRight;
        const bool off = action == Action::CompensationOff;
        const ProfileBlock &place = on ? profile.blocks.front() : profile.blocks.back();
        if ((!on && !off) || &entry == &place)
          continue;
        // Before the last block the contour may go on without it.
        const SourceRange at{ctx.source().id(), use.word->offset, entry.block.endOf(*use.word)};
        if (auto finding = ctx.report(at, event.certain))
          finding
              .message("`{0}` is inside the contour of `{1}`: compensation goes {2} block",
                       ctx.code(use).name, ctx.code(event).name,
                       on ? "on in its first" : "off in its last")
              .note(ctx.blockRange(), "the cycle is called here");
        return;
      }
  }

  bool ends_ = false; ///< compensation is to go on and off in the contour's end blocks
  static constexpr uint32_t noBlock = ~0u;
};

} // namespace
NCVET_RULE(CompensationMissingOnContour, compensation_missing_on_contour)
} // namespace ncvet
