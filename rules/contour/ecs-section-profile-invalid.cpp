// Sections of a swept surface that do not fit each other or their numbers.
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

namespace ncvet {
namespace {

/// What the tables can say of numbers and places they say; the geometry of the sections is here.
class EcsSectionProfileInvalid final : public Rule {
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

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Motion)
      return atMove(event, ctx);
    ctx.reportNotices(id, event);
    const CodeInfo &code = ctx.code(event);
    if (code.action == Action::CompensationOff)
      return atEnd(ctx);
    if (code.action != Action::ProfileBegin && code.action != Action::ProfileRun)
      return;
    section_ = isSection(code);
    if (!section_)
      first_ = {};
    counts_ = code.action == Action::ProfileBegin && has(code);
    elements_ = 0;
    start_ = {};
  }
  void remember(RuleMemory &memory) const override { memory(elements_, section_, first_, start_); }

private:
  static constexpr llvm::StringLiteral id{"ecs-section-profile-invalid"};

  static bool has(const CodeInfo &code) {
    return llvm::any_of(code.notices, [](const Notice &n) { return n.rule == id; });
  }
  /// A profile that stands for itself, one of several of the same surface.
  static bool isSection(const CodeInfo &code) {
    return code.action == Action::ProfileBegin && code.alone && has(code);
  }

  struct Ends {
    Interval from[2], to[2]; ///< along the axes of the plane
    bool known = false;
    SourceRange where;

    void remember(RuleMemory &memory) const {
      memory(from[0], from[1], to[0], to[1], known, where);
    }
  };

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

  void atMove(const Event &event, RuleContext &ctx) {
    if (ctx.before().profile != 1 || !event.axes)
      return;
    const bool begins =
        ctx.before().compensation == phaseOff && ctx.after().compensation != phaseOff;
    const bool inside = ctx.before().compensation == phaseOn && ctx.after().compensation == phaseOn;
    if (begins && section_) {
      const auto plane = axes(ctx);
      if (!plane)
        return;
      start_.known = true;
      start_.where = ctx.blockRange();
      start_.from[0] = ctx.after().at(plane->first);
      start_.from[1] = ctx.after().at(plane->second);
      compare(start_.from[1], first_.from[1], "begins", ctx);
    }
    if (!inside || !counts_ || !most_ || ++elements_ != most_ + 1)
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding.message("this is element {0} of the profile: the control takes {1}", elements_,
                      most_);
  }

  /// The block that leaves the section: where it stands in front of it is the section's end.
  void atEnd(RuleContext &ctx) {
    const auto plane = axes(ctx);
    if (!section_ || !start_.known || !plane || ctx.before().profile != 1)
      return;
    const MachineState &state = ctx.before();
    start_.to[0] = state.at(plane->first);
    start_.to[1] = state.at(plane->second);
    const auto same = [](const Interval &a, const Interval &b) {
      return a.isConstant() && b.isConstant() && a.value() == b.value();
    };
    if (same(start_.from[0], start_.to[0]) && same(start_.from[1], start_.to[1]))
      if (auto finding = ctx.report(ctx.blockRange()))
        finding.message("this section ends where it begins: a section is an open line")
            .note(start_.where, "it begins here");
    compare(start_.to[1], first_.to[1], "ends", ctx);
    if (!first_.known)
      first_ = start_;
    start_.known = false;
  }

  /// All sections of a surface begin at one ordinate, and end at one.
  void compare(const Interval &here, const Interval &there, const char *what,
               RuleContext &ctx) const {
    if (!first_.known || !here.isConstant() || !there.isConstant() || here.value() == there.value())
      return;
    if (auto finding = ctx.report(ctx.blockRange()))
      finding
          .message("this section {0} at {1}, the one before at {2}: the control joins them at one "
                   "ordinate",
                   what, here.value(), there.value())
          .note(first_.where, "the section before");
  }

  unsigned most_ = 0, elements_ = 0; ///< elements of a profile
  bool wanted_ = false;              ///< the control has sections
  bool section_ = false;             ///< one is being recorded
  bool counts_ = false;              ///< the profile that is recorded has a greatest length
  Ends first_;                       ///< of the surface
  Ends start_;                       ///< of the section at hand
};

} // namespace
NCVET_RULE(EcsSectionProfileInvalid, ecs_section_profile_invalid)
} // namespace ncvet
