// The profile of a turning cycle has a code that is not allowed there.
#include "analyzer/facts/turning_profile.h"
#include "analyzer/rule/sleep_in_stretch.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

class TurningProfileForbiddenCode final : public Rule {
public:
  void listen(Subscriptions &to) override {
    to.on(EventKind::CycleRun);
    motionOnly_ = to.dialect().facts->turning.profileOfMoves;
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.code == noCode || ctx.outcome().flow.kind != FlowKind::Profile)
      return sleepInShape();
    const CodeInfo &cycle = ctx.code(event);
    const auto ways = profileWays(ctx);
    const Profile &profile = ways.front().profile; // with all that may run
    if (cycle.cycle == CycleKind::RoughTurn)
      rapidInside(event, cycle, profile, ctx);
    std::vector<Wrong> wrongs;
    for (const ProfileBlock &entry : profile.blocks)
      for (const CodeUse &use : entry.codes)
        if (const char *what = wrongBy(ctx.code(use), cycle))
          wrongs.push_back({entry, use, what});
    if (wrongs.empty())
      return;
    // A tool among them is a sign that the numbers are those of other blocks.
    const bool isOther =
        wrongs.size() > 1 && llvm::any_of(profile.blocks, [](const ProfileBlock &entry) {
          return entry.block.has(letterAddress('T'));
        });
    for (const auto &[entry, use, what] : wrongs) {
      const SourceRange at{ctx.source().id(), use.word->offset, entry.block.endOf(*use.word)};
      auto finding = ctx.report(at, event.certain && entry.block.skip < 0);
      if (!finding)
        continue;
      const uint32_t line = ctx.source().lines().lineOf(ctx.block().begin);
      if (isOther)
        finding.message("`{0}` and {4} further codes that no profile has are in that of `{1}` in "
                        "line {2}: {3}",
                        ctx.code(use).name, cycle.name, line, what, wrongs.size() - 1);
      else
        finding.message("`{0}` is in the profile of `{1}` in line {2}: {3}", ctx.code(use).name,
                        cycle.name, line, what);
      finding.note(ctx.blockRange(), "the cycle that works along this profile");
      if (isOther)
        return;
    }
  }

private:
  /// G00 for G01 after the first cut of a profile: on towards the chuck at rapid, or between two
  /// elements that are cut. Away from its end a tool may be led at rapid.
  static void rapidInside(const Event &event, const CodeInfo &cycle, const Profile &profile,
                          RuleContext &ctx) {
    if (!profile.known || !event.certain)
      return;
    const ProfileBlock *rapid = nullptr;
    bool begun = false, inside = false;
    for (const ProfileBlock &entry : profile.blocks) {
      if (entry.block.has(letterAddress('T')) || entry.block.skip >= 0)
        return;
      if (!entry.moves || !entry.motionKnown)
        continue;
      const bool cuts = isFeed(entry.motion);
      if (begun && !rapid && entry.motion == MotionKind::Rapid) {
        rapid = &entry;
        inside = entry.toZ.hi < entry.fromZ.lo && entry.fromX == entry.toX;
      }
      inside |= rapid && cuts;
      begun |= cuts;
    }
    if (!inside)
      return;
    if (auto finding = ctx.report(rapid->range))
      finding.severity(Severity::Warning)
          .message("the profile of `{0}` goes on at rapid here: finishing leads along the work at "
                   "full speed",
                   cycle.name)
          .note(ctx.blockRange(), "the cycle that works along this profile");
  }

  /// A code that the profile may not have.
  struct Wrong {
    const ProfileBlock &entry;
    const CodeUse &use;
    const char *what;
  };

  const char *wrongBy(const CodeInfo &code, const CodeInfo &cycle) const {
    const char *what = forbidden(code);
    if (!what && motionOnly_ && code.letter == 'G' && !contour(code) &&
        !(cycle.cycle == CycleKind::PatternRepeat &&
          (code.action == Action::SurfaceSpeed || code.action == Action::ConstantSpeed)))
      what = "only moves, dwell and compensation are allowed there";
    return what;
  }

  static const char *forbidden(const CodeInfo &code) {
    switch (code.action) {
    case Action::CallProgram:
    case Action::CallLocal:
    case Action::MacroCall:
    case Action::MacroModal:
      return "a profile calls nothing";
    case Action::ConditionalJump:
    case Action::Return:
    case Action::ProgramEnd:
    case Action::ProgramEndRewind:
      return "a profile is read as data, control does not leave it";
    case Action::Cycle:
      return "no cycle runs inside a profile";
    case Action::ReferenceReturn:
    case Action::ReferenceFrom:
    case Action::MachineMove:
      return "a profile stays in work coordinates";
    case Action::WorkOffset:
    case Action::LocalShift:
    case Action::PresetPosition:
    case Action::DataInput:
      return "offsets cannot change inside a profile";
    default:
      return nullptr;
    }
  }

  static bool contour(const CodeInfo &code) {
    switch (code.action) {
    case Action::Rapid:
    case Action::Linear:
    case Action::ArcCw:
    case Action::ArcCcw:
    case Action::Dwell:
    case Action::CompensationOff:
    case Action::CompensationLeft:
    case Action::CompensationRight:
    case Action::None:
      return true;
    default:
      return false;
    }
  }

  bool motionOnly_ = false;
};

} // namespace
NCVET_RULE(TurningProfileForbiddenCode, turning_profile_forbidden_code)
} // namespace ncvet
