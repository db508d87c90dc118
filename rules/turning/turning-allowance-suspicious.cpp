// The finishing allowance of a roughing cycle has the wrong sign for the side, or there is none.
#include "analyzer/facts/turning_profile.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningAllowanceSuspicious final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    missing_ = to.dialect().facts->turning.missingAllowanceIsZero;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.outcome().flow.kind != FlowKind::Profile)
      return sleepInShape();
    const CodeInfo &cycle = ctx.code(event);
    if (cycle.cycle == CycleKind::Finish)
      return;
    checkNone(event, cycle, ctx);
    if (missing_)
      checkMissing(event, cycle, ctx);
    const Profile profile = readProfile(ctx);
    if (profile.known && profile.minZ && !isNone(profile, ctx))
      checkZ(event, cycle, profile, ctx);
    if (!profile.known || profile.side == Side::Unknown || !profile.minX || isNone(profile, ctx))
      return;
    // A start inside of the contour is that rule's business, and leaves the side in doubt.
    const Interval &start = ctx.after().at(Axis::X);
    if (!start.isConstant())
      return;
    constexpr double overshoot = 2 + 1e-6;
    const bool fits = profile.side == Side::Outside ? start.value() >= *profile.maxX - overshoot
                                                    : start.value() <= *profile.minX + overshoot;
    if (!fits)
      return;
    const bool inside = profile.side == Side::Inside;
    for (const WordSpec &spec : cycle.words) {
      if (spec.role != Role::AllowanceX && spec.role != Role::StockX)
        continue;
      const Word *word = wordFor(ctx.block(), spec);
      if (!word)
        continue;
      const Interval value = ctx.value(*word);
      // One place a little past the axis is where a face ends.
      const bool beyondAxis = *profile.maxX <= 0 && *profile.minX < *profile.maxX;
      if (!value.isConstant() || value.value() == 0 ||
          (value.value() < 0) == (inside || beyondAxis))
        continue;
      if (spec.role == Role::StockX) {
        stockOnWrongSide(*word, event, cycle, inside, profile, ctx);
        continue;
      }
      if (auto finding = ctx.report(*word, event.certain))
        finding
            .message(beyondAxis ? "`{0}` is positive, and the contour of `{1}` is at negative "
                                  "X, where the allowance is negative too: the part is cut "
                                  "undersize"
                     : inside
                         ? "`{0}` is positive, but `{1}` roughs inside: the bore is cut oversize"
                         : "`{0}` is negative, but `{1}` roughs outside: the part is cut undersize",
                     ctx.text(*word), cycle.name)
            .note(profile.blocks.front().range, "the profile begins here");
    }
  }

private:
  /// Blocks that call tools or go home are no contour: the numbers are those of other blocks.
  static bool isNone(const Profile &profile, const RuleContext &ctx) {
    return llvm::any_of(profile.blocks, [&](const ProfileBlock &entry) {
      return entry.block.has(letterAddress('T')) ||
             llvm::any_of(entry.codes, [&](const CodeUse &use) {
               const Action action = ctx.code(use).action;
               return action == Action::ReferenceReturn || action == Action::Cycle;
             });
    });
  }

  /// The allowance along Z points away from the material: towards the end at which the cycle begins
  /// on the contour, and its faces are cut below their size.
  static void checkZ(const Event &event, const CodeInfo &cycle, const Profile &profile,
                     RuleContext &ctx) {
    constexpr double beside = 1e-6;
    const Word *const word = wordOf(ctx.block(), cycle, Role::AllowanceZ);
    const Interval &start = ctx.after().at(Axis::Z);
    if (!word || !start.isConstant() || ctx.after().inMachineCoordinates(Axis::Z) ||
        *profile.maxZ - *profile.minZ < beside)
      return;
    const Interval value = ctx.value(*word);
    const bool fromFront = start.value() >= *profile.maxZ - beside;
    if (!value.isConstant() || value.value() == 0 ||
        (!fromFront && start.value() > *profile.minZ + beside) || (value.value() > 0) == fromFront)
      return;
    if (auto finding = ctx.report(*word, event.certain))
      finding
          .message("`{0}` is {1}, but `{2}` begins {3} its contour: roughing cuts its faces below "
                   "their size",
                   ctx.text(*word), fromFront ? "negative" : "positive", cycle.name,
                   fromFront ? "before" : "after")
          .note(profile.blocks.front().range, "the profile begins here");
  }

  /// The distance from the first pass along the contour to the last is signed in the same way.
  static void stockOnWrongSide(const Word &word, const Event &event, const CodeInfo &cycle,
                               bool inside, const Profile &profile, RuleContext &ctx) {
    if (auto finding = ctx.report(word, event.certain))
      finding
          .message("`{0}` is {1}, but `{2}` roughs {3}: the first passes are beyond the finished "
                   "contour",
                   ctx.text(word), inside ? "positive" : "negative", cycle.name,
                   inside ? "inside" : "outside")
          .note(profile.blocks.front().range, "the profile begins here");
  }

  /// Neither of the two words: the same as two zeros.
  static void checkMissing(const Event &event, const CodeInfo &cycle, RuleContext &ctx) {
    bool takes = false;
    for (const WordSpec &spec : cycle.words)
      if (spec.role == Role::AllowanceX || spec.role == Role::AllowanceZ) {
        if (wordFor(ctx.block(), spec))
          return;
        takes = true;
      }
    if (!takes)
      return;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` roughs to size: no allowance covers the form errors of roughing without "
                   "nose compensation",
                   cycle.name)
          .severity(Severity::Style);
  }

  /// The profile is one face or one diameter: there is no form to be falsified.
  static bool isOneCut(const RuleContext &ctx) {
    const Profile profile = readProfile(ctx);
    return profile.known && llvm::count_if(profile.blocks, [](const ProfileBlock &block) {
                              return block.moves && block.motion != MotionKind::Rapid;
                            }) <= 1;
  }

  static void checkNone(const Event &event, const CodeInfo &cycle, RuleContext &ctx) {
    const Word *x = wordOf(ctx.block(), cycle, Role::AllowanceX);
    const Word *z = wordOf(ctx.block(), cycle, Role::AllowanceZ);
    if (!x || !z)
      return;
    const Interval ofX = ctx.value(*x), ofZ = ctx.value(*z);
    if (!ofX.isConstant() || !ofZ.isConstant() || ofX.value() != 0 || ofZ.value() != 0 ||
        isOneCut(ctx))
      return;
    if (auto finding = ctx.report(*x, event.certain))
      finding
          .message(
              "`{0}` roughs to size: no allowance covers the form errors of roughing without nose "
              "compensation",
              cycle.name)
          .severity(Severity::Style);
  }

  bool missing_ = false; ///< words that are left out count as zeros
};

} // namespace
NCVET_RULE(TurningAllowanceSuspicious, turning_allowance_suspicious)
} // namespace ncvet
