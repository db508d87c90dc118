// A zone that was set with one tool is used with another.
#include "analyzer/rule/rule.h"

#include <bit>

namespace ncvet {
namespace {

struct LimitZoneNotEffectiveMemory {
  /// Groups whose zone was set with the length of a tool: by an offset in force, or on a lathe by
  /// the tool's own.
  uint64_t withLength = 0;
  bool cut = false; ///< since a zone was set or switched
};

class LimitZoneNotEffective final : public StatefulRule<LimitZoneNotEffectiveMemory> {
public:
  void listen(Subscriptions &to) override {
    if (llvm::any_of(to.dialect().codes,
                     [](const CodeInfo &code) { return code.action == Action::ZoneOn; }))
      to.on(EventKind::ToolChange);
    to.onAction({Action::ZoneOn});
    if (llvm::any_of(to.dialect().switches, [](const SwitchInfo &s) { return s.leftOn == id; })) {
      to.on(EventKind::ProgramEnd);
      to.onMoves({MotionKind::Feed, MotionKind::ArcCw, MotionKind::ArcCcw});
    }
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Motion) {
      memory().cut = true;
      return;
    }
    if (event.kind == EventKind::ProgramEnd)
      return memory().cut ? void() : outlives(event, ctx);
    if (event.kind == EventKind::Code)
      return isSet(event, ctx);
    const MachineState &before = ctx.before();
    const Dialect &dialect = ctx.dialect();
    if (before.tool == notSet)
      return;
    for (size_t i = 0; i < dialect.groups.size(); ++i) {
      if (!std::has_single_bit(before.group(i)) || before.group(i) == groupUnset)
        continue;
      const Origin zone = before.origin.ofGroup(i);
      const auto member = size_t(std::countr_zero(before.group(i)));
      if (dialect.codes[dialect.groups[i].members[member]].action != Action::ZoneOn ||
          !(memory().withLength >> i & 1))
        continue;
      memory().withLength &= ~(uint64_t(1) << i);
      if (auto finding = ctx.report(event))
        finding
            .message("the zone was set with the length offset of the tool before: it guards the "
                     "wrong height now")
            .note(zone, "the zone is switched on here");
    }
  }

private:
  static constexpr llvm::StringLiteral id{"limit-zone-not-effective"};

  /// The limits are converted with the length that counts where they are set, whatever switches it
  /// off later.
  void isSet(const Event &event, RuleContext &ctx) const {
    memory().cut = false;
    const GroupIndex group = ctx.code(event).group;
    if (group == noGroup || group >= 64)
      return;
    const MachineState &before = ctx.before();
    const bool length =
        ctx.dialect().isLathe()
            ? before.must(Fact::ToolCalled)
            : before.isActive(ctx.dialect(), StandardGroup::LengthOffset,
                              {Action::LengthPositive, Action::LengthNegative}) == Truth::Yes;
    const uint64_t bit = uint64_t(1) << group;
    memory().withLength = length ? memory().withLength | bit : memory().withLength & ~bit;
  }

  /// What neither the end nor a reset switches off acts in the next program too. Where this one has
  /// cut under it, it was for this one; which code switches it off is the machine's.
  static void outlives(const Event &event, RuleContext &ctx) {
    for (unsigned i = 0; i < ctx.dialect().switches.size(); ++i) {
      const SwitchInfo &info = ctx.dialect().switches[i];
      const Origin &origin = ctx.after().origin.ofSwitch(i);
      if (info.leftOn != id || !ctx.after().switchMustBeOn(i) || !origin.known() ||
          ctx.after().may(Fact::UnknownCode))
        continue;
      if (auto finding = ctx.report(origin.range(), event.certain))
        finding.severity(info.severity)
            .message("{0} is on at the program's end, and no cut comes after it: it acts in the "
                     "programs after this one",
                     info.title)
            .note(ctx.blockRange(), "the program ends here");
    }
  }
};

} // namespace
NCVET_RULE(LimitZoneNotEffective, limit_zone_not_effective)
} // namespace ncvet
