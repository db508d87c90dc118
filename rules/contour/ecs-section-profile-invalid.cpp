// Sections of a swept surface that do not fit each other or their numbers.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

struct EcsSectionProfileInvalidMemory {
  struct Ends {
    Interval from[2], to[2]; ///< along the axes of the plane
    bool known = false;
    SourceRange where;
  };
  unsigned elements = 0; ///< elements of a profile
  bool section = false;  ///< one is being recorded
  Ends first;            ///< of the surface
  Ends start;            ///< of the current section
  bool counts = false;   ///< the profile that is recorded has a greatest length
};

/// What the tables can say of numbers and places they say; the geometry of the sections is here.
class EcsSectionProfileInvalid final : public StatefulRule<EcsSectionProfileInvalidMemory> {
public:
  void listen(Subscriptions &to) override {
    to.handleNotices();
    most_ = to.dialect().facts->limits.sectionElements;
    for (const CodeInfo &code : to.dialect().codes)
      wanted_ |= isSection(code);
    if (!wanted_)
      return;
    to.onCode([](const CodeInfo &code) {
      return code.action == Action::ProfileBegin || code.action == Action::ProfileRun ||
             code.action == Action::CompensationOff ||
             llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
    });
    to.on(EventKind::Motion);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion)
      return atMove(event, ctx);
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (code.action == Action::CompensationOff)
      return atEnd(ctx);
    if (code.action != Action::ProfileBegin && code.action != Action::ProfileRun)
      return;
    memory().section = isSection(code);
    if (!memory().section)
      memory().first = {};
    memory().counts = code.action == Action::ProfileBegin && has(code);
    memory().elements = 0;
    memory().start = {};
  }

private:
  static constexpr llvm::StringLiteral id{"ecs-section-profile-invalid"};

  static bool has(const CodeInfo &code) {
    return llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
  }
  /// A profile of its own, one of several of the same surface.
  static bool isSection(const CodeInfo &code) {
    return code.action == Action::ProfileBegin && code.alone && has(code);
  }

  /// Axes of the plane, the first one first; none when it is not one of three.
  static std::optional<std::pair<Axis, Axis>> axes(const RuleContext &ctx) {
    switch (ctx.after().activeAction(ctx.dialect(), StandardGroup::Plane)) {
    case Action::PlaneXY:
      return std::pair(Axis::X, Axis::Y);
    case Action::PlaneZX:
      return std::pair(Axis::Z, Axis::X);
    case Action::PlaneYZ:
      return std::pair(Axis::Y, Axis::Z);
    default:
      return std::nullopt;
    }
  }

  void atMove(const Event &event, RuleContext &ctx) const {
    if (ctx.before().profile != ProfileMode::Recorded || !event.axes)
      return;
    const bool begins =
        ctx.before().compensation == phaseOff && ctx.after().compensation != phaseOff;
    const bool inside = ctx.before().compensation == phaseOn && ctx.after().compensation == phaseOn;
    if (begins && memory().section) {
      const auto plane = axes(ctx);
      if (!plane)
        return;
      memory().start.known = true;
      memory().start.where = ctx.blockRange();
      memory().start.from[0] = ctx.after().at(plane->first);
      memory().start.from[1] = ctx.after().at(plane->second);
      compare(memory().start.from[1], memory().first.from[1], "begins", ctx);
    }
    if (!inside || !memory().counts || !most_ || ++memory().elements != most_ + 1)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("this is element {0} of the profile: the control takes {1}",
                      memory().elements, most_);
  }

  /// The block that leaves the section: the place before it is the section's end.
  void atEnd(RuleContext &ctx) const {
    const auto plane = axes(ctx);
    if (!memory().section || !memory().start.known || !plane ||
        ctx.before().profile != ProfileMode::Recorded)
      return;
    const MachineState &state = ctx.before();
    memory().start.to[0] = state.at(plane->first);
    memory().start.to[1] = state.at(plane->second);
    const auto same = [](const Interval &a, const Interval &b) {
      return a.isConstant() && b.isConstant() && a.value() == b.value();
    };
    if (same(memory().start.from[0], memory().start.to[0]) &&
        same(memory().start.from[1], memory().start.to[1]))
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.message("this section ends where it begins: a section is an open line")
            .note(memory().start.where, "it begins here");
    compare(memory().start.to[1], memory().first.to[1], "ends", ctx);
    if (!memory().first.known)
      memory().first = memory().start;
    memory().start.known = false;
  }

  /// All sections of a surface begin at one ordinate, and end at one.
  void compare(const Interval &here, const Interval &there, const char *what,
               RuleContext &ctx) const {
    if (!memory().first.known || !here.isConstant() || !there.isConstant() ||
        here.value() == there.value())
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("this section {0} at {1}, the one before at {2}: the control joins them at one "
                   "ordinate",
                   what, here.value(), there.value())
          .note(memory().first.where, "the section before");
  }

  unsigned most_ = 0;   ///< elements of a profile
  bool wanted_ = false; ///< the control has sections
};

} // namespace
NCVET_RULE(EcsSectionProfileInvalid, ecs_section_profile_invalid)
} // namespace ncvet
