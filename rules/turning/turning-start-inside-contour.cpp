// A turning cycle starts inside of what it is to cut.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/thread_passes.h"
#include "analyzer/facts/turning_profile.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/text/number_text.h"

namespace ncvet {
namespace {

constexpr double startTolerance = 1e-4; // mm
constexpr double overshoot = 2; // mm in diameter, by which a last facing block may pass the start

class TurningStartInsideContour final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on({EventKind::CycleRun});
    passes_ = to.flag("passes");
    mayPassWhenLeaving_ = to.flag("mayPassWhenLeaving");
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode)
      return;
    const CodeInfo &code = ctx.code(event);
    switch (code.cycle) {
    case CycleKind::RoughTurn:
    case CycleKind::RoughFace:
    case CycleKind::PatternRepeat:
      rough(event, code, ctx);
      break;
    case CycleKind::Finish:
      finish(event, code, ctx);
      break;
    case CycleKind::TurnPass:
    case CycleKind::FacePass:
      if (!leadsAway(event, code, ctx) && passes_)
        pass(event, code, ctx);
      break;
    case CycleKind::ThreadPass: // of a list of passes the rule of the thread's start speaks
      if (passes_ && threadPassesAhead(ctx, 0).empty())
        pass(event, code, ctx);
      break;
    default:
      sleepInShape();
    }
  }

private:
  /// A finishing cycle goes at rapid to the diameter of its first block, past the face that its
  /// second one begins at.
  static void finish(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    constexpr double clearly = 0.5; // mm
    constexpr auto x = uint16_t(1u << unsigned(Axis::X));
    const Interval &startX = ctx.after().at(Axis::X), &startZ = ctx.after().at(Axis::Z);
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    if (ctx.outcome().flow.kind != FlowKind::Profile || !startX.isConstant() ||
        !startZ.isConstant() || !unit || ctx.after().inMachineCoordinates(Axis::Z))
      return;
    const Profile profile = readProfile(ctx);
    if (!profile.known || !profile.maxZ || !profile.minZ || profile.blocks.size() < 3)
      return;
    const ProfileBlock &head = profile.blocks.front(), &tail = profile.blocks[profile.lastCut - 1];
    const auto second = llvm::find_if(llvm::drop_begin(profile.blocks),
                                      [](const ProfileBlock &entry) { return entry.moves; });
    if (!head.moves || head.motion != MotionKind::Rapid || head.axes != x ||
        second == profile.blocks.end() || !second->toZ.isConstant() || !tail.toZ.isConstant() ||
        !head.toX.isConstant() || head.toX.value() >= startX.value() ||
        second->toZ.value() < startZ.value() + clearly || tail.toZ.value() >= startZ.value())
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message("`{0}` starts at Z{1}, past the face Z{2} of its contour: its first block "
                   "leads through the work at rapid",
                   code.name, shortNumber(startZ.value() / *unit),
                   shortNumber(second->toZ.value() / *unit))
          .note(head.range, "the profile begins here");
  }

  void rough(const Event &event, const CodeInfo &code, RuleContext &ctx) const {
    if (ctx.outcome().flow.kind != FlowKind::Profile)
      return;
    const Interval &startX = ctx.after().at(Axis::X), &startZ = ctx.after().at(Axis::Z);
    const Profile profile = readProfile(ctx);
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    if (!profile.known || !unit || ctx.after().inMachineCoordinates(Axis::X))
      return;
    if (code.cycle == CycleKind::RoughFace) {
      if (startZ.isConstant() && profile.maxZ && !ctx.after().inMachineCoordinates(Axis::Z) &&
          profile.minZ && startZ.value() < *profile.maxZ - startTolerance &&
          startZ.value() > *profile.minZ + startTolerance)
        if (auto finding = ctx.report(event, event.certain))
          finding.message(
              "`{0}` starts at Z{1}, inside of its contour, which reaches from Z{2} to Z{3}: "
              "the tool returns to the start at rapid",
              code.name, shortNumber(startZ.value() / *unit), shortNumber(*profile.minZ / *unit),
              shortNumber(*profile.maxZ / *unit));
    }
    if (code.cycle == CycleKind::RoughTurn && startZ.isConstant() && profile.maxZ &&
        !ctx.after().inMachineCoordinates(Axis::Z) && startsPastFront(profile, startZ.value())) {
      if (auto finding = ctx.report(event, event.certain))
        finding
            .message("`{0}` starts at Z{1}, inside its contour, which reaches from "
                     "Z{2} to Z{3}: every pass returns there at rapid",
                     code.name, shortNumber(startZ.value() / *unit),
                     shortNumber(*profile.maxZ / *unit), shortNumber(*profile.minZ / *unit))
            .note(profile.blocks.front().range, "the profile begins here");
      return;
    }
    if (code.cycle == CycleKind::RoughTurn && insidePart(event, code, profile, *unit, ctx))
      return;
    if (!startX.isConstant() || profile.reachesX.lo > profile.reachesX.hi)
      return;
    const double start = startX.value();
    const double least = profile.reachesX.lo, greatest = profile.reachesX.hi;
    double over = 0;
    if (profile.side == Side::Outside && start < greatest - startTolerance)
      over = greatest - start;
    else if (profile.side == Side::Inside && start > least + startTolerance)
      over = start - least;
    else if (profile.side == Side::Unknown && start < greatest - startTolerance &&
             start > least + startTolerance)
      over = std::min(greatest - start, start - least);
    if (over <= 0 || (mayPassWhenLeaving_ && leavesOnly(profile, start)))
      return;
    if (auto finding = ctx.report(event, event.certain))
      finding
          .message(
              "`{0}` starts at X{1}, inside of its contour, which reaches from X{2} to X{3}: the "
              "tool returns to the start at rapid",
              code.name, shortNumber(start / *unit), shortNumber(least / *unit),
              shortNumber(greatest / *unit))
          .severity(over <= overshoot + startTolerance ? std::optional(Severity::Warning)
                                                       : std::nullopt)
          .note(profile.blocks.front().range, "the profile begins here");
  }

  /// Only the last blocks, in X alone, pass the start: out of the part by a little, or into the
  /// room inside a bore. The path back from there is free.
  static bool leavesOnly(const Profile &profile, double start) {
    constexpr auto x = uint16_t(1u << unsigned(Axis::X));
    size_t end = profile.lastCut;
    while (end > 1 && profile.blocks[end - 1].axes == x)
      --end;
    if (end == profile.lastCut || profile.side == Side::Unknown)
      return false;
    Interval walls = emptyInterval;
    for (size_t i = 0; i < end; ++i)
      if (const Interval &to = profile.blocks[i].toX; profile.blocks[i].moves) {
        if (!to.isConstant())
          return false;
        walls.lo = std::min(walls.lo, to.value());
        walls.hi = std::max(walls.hi, to.value());
      }
    if (walls.lo > walls.hi)
      return false;
    const bool outside = profile.side == Side::Outside;
    const bool free =
        outside ? start >= walls.hi - startTolerance : start <= walls.lo + startTolerance;
    return free && (!outside || profile.reachesX.hi - start <= overshoot + startTolerance);
  }

  /// A contour that is cut towards the chuck, from a start inside the part. True when that is said.
  static bool insidePart(const Event &event, const CodeInfo &code, const Profile &profile,
                         double unit, RuleContext &ctx) {
    const auto face = ctx.machine().number("partFaceZ");
    const Interval &z = ctx.after().at(Axis::Z);
    const Interval &tail = profile.blocks[profile.lastCut - 1].toZ;
    if (!face || !z.isConstant() || ctx.after().inMachineCoordinates(Axis::Z) ||
        z.value() >= *face - startTolerance || !tail.isConstant() ||
        tail.value() >= z.value() - startTolerance)
      return false;
    if (auto finding = ctx.report(event, event.certain))
      finding.message("`{0}` starts at Z{1}, inside the part, whose face is at Z{2}: every pass "
                      "returns there at rapid",
                      code.name, shortNumber(z.value() / unit), shortNumber(*face / unit));
    return true;
  }

  /// A contour that is cut towards the chuck begins before the place, by more than the distance
  /// at which one starts before a face.
  static bool startsPastFront(const Profile &profile, double z) {
    const ProfileBlock &head = profile.blocks.front(), &tail = profile.blocks[profile.lastCut - 1];
    return head.toZ.isConstant() && tail.toZ.isConstant() &&
           head.toZ.value() >= *profile.maxZ - startTolerance &&
           tail.toZ.value() < head.toZ.value() - startTolerance && z < *profile.maxZ - overshoot &&
           z > *profile.minZ + startTolerance;
  }

  /// A single pass returns to its start: what follows tells on which side the tool works.
  static void pass(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    if (!ctx.codeWord(event))
      return;
    const auto unit = millimetresPer(ctx.dialect(), ctx.after());
    const bool face = code.cycle == CycleKind::FacePass;
    const Axis axis = face ? Axis::Z : Axis::X;
    const Interval &start = ctx.after().cycleStart[unsigned(axis)];
    const auto end =
        ctx.before().inMachineCoordinates(axis) ? std::nullopt : endOf(ctx, axis, start);
    if (!unit || !end || !start.isConstant() || *end <= start.value() + startTolerance)
      return;
    if (!face && !leavesOutwards(ctx, *end / *unit))
      return;
    if (auto finding = ctx.report(event, false))
      finding.message(
          face ? "`{0}` starts at Z{1}, beyond the face Z{2} that it cuts: the tool returns "
                 "through it at rapid"
               : "`{0}` starts at X{1}, below the diameter X{2} that it turns on the outside: it "
                 "returns through the part at rapid",
          code.name, shortNumber(start.value() / *unit), shortNumber(*end / *unit));
  }

  /// A pass along the work that begins before the face and leads away from it: it has lost its
  /// sign.
  static bool leadsAway(const Event &event, const CodeInfo &code, RuleContext &ctx) {
    constexpr double least = 3; // mm
    const Interval &start = ctx.after().cycleStart[unsigned(Axis::Z)];
    const Word *const word = ctx.block().find('Z');
    if (code.cycle == CycleKind::FacePass || !word || !ctx.codeWord(event) || !start.isConstant() ||
        start.value() < 0 || ctx.before().inMachineCoordinates(Axis::Z) ||
        !ctx.after().frames.empty())
      return false;
    const auto end = endOf(ctx, Axis::Z, start);
    if (!end || *end < start.value() + least)
      return false;
    if (auto finding = ctx.report(*word, event.certain))
      finding.severity(Severity::Warning)
          .message("`{0}`: `{1}` begins before the face of the part and cuts away from it",
                   ctx.text(*word), code.name);
    return true;
  }

  /// The passes lead towards the axis, or after them the tool leaves straight outwards in X, which
  /// a boring bar could not do; and no later pass is larger.
  static bool leavesOutwards(const RuleContext &ctx, double diameter) {
    BlocksAhead ahead(ctx);
    Block next;
    bool more = ahead.next(next);
    for (unsigned i = 0; more && i < 30; ++i, more = ahead.next(next)) {
      if (!next.items.empty())
        return false;
      const Word *x = next.find('X');
      if (!findCode(ctx.dialect(), next, {Action::Rapid})) {
        if (hasMotionCode(ctx.dialect(), next) || (x && x->isNumber() && x->value() > diameter))
          return false;
        if (x && x->isNumber() && x->value() < diameter)
          return true; // a bore grows from pass to pass
        continue;
      }
      return x && x->isNumber() && x->value() > diameter && !next.hasAny(lettersMask("ZWU")) &&
             !findCode(ctx.dialect(), next, {Action::MachineMove, Action::ReferenceReturn});
    }
    return false;
  }

  bool mayPassWhenLeaving_ = false;
  bool passes_ = false; ///< single passes too: a bar that bores looks the same in the text
};

} // namespace
NCVET_RULE(TurningStartInsideContour, turning_start_inside_contour)
} // namespace ncvet
