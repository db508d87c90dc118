// A new phase of the program resets what is still needed.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {
namespace {

class EcsPhaseResetsState final : public Rule {
public:
  void listen(Subscriptions &to) override { to.onAction({Action::Reset}); }

  void on(const Event &event, RuleContext &ctx) const override {
    if (!ctx.block().mainBlock || ctx.before().may(Fact::UnknownCode))
      return;
    const MachineState &before = ctx.before();
    const char *inside = nullptr;
    if (before.compensation & phaseOn)
      inside = "radius compensation";
    else if (before.cycleActive(ctx.dialect()) == Truth::Yes)
      inside = "a cycle";
    else if (before.switches.areOn(~0u))
      inside = "a frame or mode";
    if (inside) {
      if (auto finding = ctx.report(event))
        finding.message("`{0}` begins while {1} is on: it is reset in the middle of its work",
                        ctx.text(*event.word), inside);
      return;
    }
    if (motion(event, ctx))
      return;
    // Modes that the program has chosen, and that are no more.
    for (size_t i = 0; i < ctx.dialect().groups.size(); ++i) {
      const GroupInfo &group = ctx.dialect().groups[i];
      if (group.initial == 0xFF || !before.isStated(i) || group.id == "motion" ||
          (before.group(i) & (uint64_t(1) << group.initial)) || restated(GroupIndex(i), ctx))
        continue;
      if (auto finding = ctx.report(event))
        finding
            .message("`{0}` resets the {1}, which the program has set: the blocks after it have to "
                     "state it again",
                     ctx.text(*event.word), group.title)
            .note(before.origin.ofGroup(i), "it is set here");
      return;
    }
  }

private:
  /// A move after the mark without a motion code, where another one than the initial was in force.
  static bool motion(const Event &event, RuleContext &ctx) {
    const GroupIndex index = ctx.dialect().group(StandardGroup::Motion);
    if (index == noGroup)
      return false;
    const GroupInfo &group = ctx.dialect().groups[index];
    if (group.initial == 0xFF || (ctx.before().group(index) & (uint64_t(1) << group.initial)))
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    bool more = ahead.next(next);
    for (unsigned i = 0; more && i < 8; ++i, more = ahead.next(next)) {
      if (hasMotionCode(ctx.dialect(), next) || !next.items.empty())
        return false;
      if (!next.hasAny(ctx.dialect().axisWords))
        continue;
      const SourceRange move = ahead.range(next);
      if (auto finding = ctx.report(move))
        finding
            .message("`{0}` has no motion code after a mark that resets: it is driven with `{1}`",
                     ctx.text(move), ctx.dialect().codes[group.members[group.initial]].name)
            .note(ctx.range(*event.word), "the mark");
      return true;
    }
    return false;
  }

  /// One of the next blocks has a code of the group, before a move.
  static bool restated(GroupIndex group, RuleContext &ctx) {
    BlocksAhead ahead(ctx);
    Block next;
    bool more = ahead.next(next);
    for (unsigned i = 0; more && i < 8; ++i, more = ahead.next(next)) {
      for (const CodeIndex code : codesOf(ctx.dialect(), next))
        if (ctx.dialect().codes[code].group == group)
          return true;
      if (next.hasAny(ctx.dialect().axisWords))
        return false;
    }
    return true;
  }
};

} // namespace
NCVET_RULE(EcsPhaseResetsState, ecs_phase_resets_state)
} // namespace ncvet
