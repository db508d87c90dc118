// A new phase of the program resets what is still needed.
#include "analyzer/facts/blocks_ahead.h"
#include "analyzer/facts/lookahead.h"

namespace ncvet {
namespace {

/// Blocks read after a mark: a phase states its modes at its begin.
constexpr unsigned blocksOfPhase = 60;

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
    if (inside) {
      if (auto finding = ctx.report(event))
        finding.message("`{0}` begins while {1} is on: it is reset in the middle of its work",
                        ctx.text(*event.word), inside);
      return;
    }
    if (motion(event, ctx) || length(event, ctx) || plane(event, ctx))
      return;
    for (const StandardGroup which :
         {StandardGroup::WorkOffset, StandardGroup::Units, StandardGroup::FeedMode})
      if (lost(which, event, ctx))
        return;
  }

private:
  /// A mode that the program has chosen, and that the blocks after the mark do not state again.
  static bool lost(StandardGroup which, const Event &event, RuleContext &ctx) {
    const GroupIndex index = ctx.dialect().group(which);
    if (index == noGroup)
      return false;
    const GroupInfo &group = ctx.dialect().groups[index];
    if (group.initial == 0xFF || !ctx.before().isStated(index) ||
        (ctx.before().group(index) & (uint64_t(1) << group.initial)) || restated(index, ctx))
      return false;
    if (auto finding = ctx.report(event))
      finding
          .message("`{0}` resets the {1}, which the program has set: the blocks after it have to "
                   "state it again",
                   ctx.text(*event.word), group.title)
          .note(ctx.before().origin.ofGroup(index), "it is set here");
    return true;
  }

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

  /// A move along the tool before the length of the tool counts again.
  static bool length(const Event &event, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const int32_t tool = ctx.before().tool;
    const GroupIndex group = dialect.lengthByTool;
    if (tool == notSet || tool == notKnown || group == noGroup)
      return false;
    const uint16_t along = uint16_t(1u << unsigned(Axis::Z));
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < blocksOfPhase && ahead.next(next); ++i) {
      for (const CodeIndex index : codesOf(dialect, next)) {
        const CodeInfo &code = dialect.codes[index];
        if (code.group == group || code.action == Action::ToolChange ||
            code.action == Action::MachineMove || code.action == Action::Reset ||
            code.action == Action::DataInput)
          return false;
      }
      if (!(axesOf(dialect, next) & along))
        continue;
      const SourceRange move = ahead.range(next);
      if (auto finding = ctx.report(move))
        finding
            .message("`{0}` moves without the length of the tool: the mark has switched it off, "
                     "and no tool change or length code has switched it on again",
                     ctx.text(move))
            .note(ctx.range(*event.word), "the mark");
      return true;
    }
    return false;
  }

  /// An arc with words of the plane that was in force before the mark, not of the plane after it.
  static bool plane(const Event &event, RuleContext &ctx) {
    const Dialect &dialect = ctx.dialect();
    const GroupIndex group = dialect.group(StandardGroup::Plane);
    const uint16_t was = planeAxes(dialect, ctx.before()), is = planeAxes(dialect, ctx.after());
    if (group == noGroup || was == is || !ctx.before().activeCode(dialect, StandardGroup::Plane))
      return false;
    BlocksAhead ahead(ctx);
    Block next;
    for (unsigned i = 0; i < blocksOfPhase && ahead.next(next); ++i) {
      for (const CodeIndex index : codesOf(dialect, next))
        if (dialect.codes[index].group == group || dialect.codes[index].action == Action::Reset)
          return false;
      if (!findCode(dialect, next, {Action::ArcCw, Action::ArcCcw}))
        continue;
      const uint16_t axes = uint16_t(axesOf(dialect, next) | centreAxes(next));
      if (!(axes & ~is) || (axes & ~was))
        return false;
      const SourceRange arc = ahead.range(next);
      if (auto finding = ctx.report(arc))
        finding
            .message("`{0}` is an arc of the plane before the mark: the mark has reset the plane",
                     ctx.text(arc))
            .note(ctx.range(*event.word), "the mark")
            .note(ctx.before().origin.ofGroup(group), "the plane is set here");
      return true;
    }
    return false;
  }

  /// Axes of the centre words of an arc.
  static uint16_t centreAxes(const Block &block) {
    uint16_t axes = 0;
    for (unsigned i = 0; i < 3; ++i)
      if (block.has(letterAddress(char('I' + i))))
        axes |= uint16_t(1u << i);
    return axes;
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
