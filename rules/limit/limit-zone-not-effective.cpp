// A zone that was set with one tool is used with another.
#include "analyzer/rule/rule.h"

#include <bit>

namespace ncvet {
namespace {

class LimitZoneNotEffective final : public Rule {
public:
  void listen(Subscriptions &to) override {
    if (llvm::any_of(to.dialect().codes,
                     [](const CodeInfo &code) { return code.action == Action::ZoneOn; }))
      to.on(EventKind::ToolChange);
    if (llvm::any_of(to.dialect().switches, [](const SwitchInfo &s) { return s.leftOn == id; }))
      to.on(EventKind::ProgramEnd);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::ProgramEnd)
      return outlives(event, ctx);
    const MachineState &before = ctx.before();
    const Dialect &dialect = ctx.dialect();
    if (before.tool == notSet || !before.origin.of(StatePart::LengthOffset).known() ||
        before.isActive(dialect, StandardGroup::LengthOffset,
                        {Action::LengthPositive, Action::LengthNegative}) != Truth::Yes)
      return;
    for (size_t i = 0; i < dialect.groups.size(); ++i) {
      if (!std::has_single_bit(before.group(i)) || before.group(i) == groupUnset)
        continue;
      const Origin zone = before.origin.ofGroup(i);
      const auto member = size_t(std::countr_zero(before.group(i)));
      if (dialect.codes[dialect.groups[i].members[member]].action != Action::ZoneOn ||
          zone.file != before.origin.of(StatePart::LengthOffset).file ||
          zone.begin < before.origin.of(StatePart::LengthOffset).begin)
        continue;
      if (auto finding = ctx.report(event))
        finding
            .message("the zone was set with the length offset of the tool before: it guards the "
                     "wrong height now")
            .note(zone, "the zone is switched on here");
    }
  }

private:
  static constexpr llvm::StringLiteral id{"limit-zone-not-effective"};

  /// What neither the end nor a reset switches off acts in the next program too.
  static void outlives(const Event &event, RuleContext &ctx) {
    for (unsigned i = 0; i < ctx.dialect().switches.size(); ++i) {
      const SwitchInfo &info = ctx.dialect().switches[i];
      const Origin &origin = ctx.after().origin.ofSwitch(i);
      if (info.leftOn != id || !ctx.after().switchMustBeOn(i) || !origin.known() ||
          ctx.after().may(Fact::UnknownCode))
        continue;
      if (auto finding = ctx.report(origin.range(), event.certain))
        finding.severity(info.severity)
            .message("{0} is still on at the program's end: it acts in the programs after it",
                     info.title)
            .note(ctx.blockRange(), "the program ends here");
    }
  }
};

} // namespace
NCVET_RULE(LimitZoneNotEffective, limit_zone_not_effective)
} // namespace ncvet
