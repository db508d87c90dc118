// A block is reached in different modes, depending on the path.
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"

#include <map>
#include <set>

namespace ncvet {
namespace {

struct FlowStateDiffersAtJoinMemory {
  struct Target {
    std::map<GroupIndex, uint64_t> seen; ///< members that were active
    bool said = false;
  };
  std::map<std::pair<FileId, uint32_t>, Target> targets;
};

class FlowStateDiffersAtJoin final : public StatefulRule<FlowStateDiffersAtJoinMemory> {
public:
  void listen(Subscriptions &to) override {
    if (!to.dialect().facts->program.modesStatedAtTargets)
      return;
    to.on({EventKind::Statement, EventKind::Block});
    for (const StandardGroup which :
         {StandardGroup::Distance, StandardGroup::Plane, StandardGroup::Units,
          StandardGroup::Compensation, StandardGroup::Cycle, StandardGroup::WorkOffset})
      if (const GroupIndex group = to.dialect().group(which); group != noGroup)
        groups_.push_back(group);
  }

  void on(const Event &event, RuleContext &ctx) const override {
    if (event.kind == EventKind::Statement)
      return target(ctx.block().items[event.item()], ctx);
    if (memory().targets.empty() || ctx.callDepth() > 0)
      return;
    const auto at = memory().targets.find({ctx.source().id(), ctx.block().begin});
    if (at == memory().targets.end() || at->second.said)
      return;
    Memory::Target &here = at->second;
    const MachineState &state = ctx.before();
    if (state.may(Fact::UnknownCode))
      return;
    for (const GroupIndex group : groups_) {
      const uint64_t now = state.group(group);
      uint64_t &seen = here.seen[group];
      if ((!seen || seen == now) && !(now & (now - 1))) {
        seen = now;
        continue;
      }
      // What the block states itself does not count.
      if ((now | seen) & groupUnset || states(group, ctx) || !uses(ctx)) {
        seen = now;
        continue;
      }
      here.said = true;
      if (auto finding = ctx.report(ctx.blockRange(), false))
        finding
            .message("this block is reached with different states of {0}, depending on the path",
                     ctx.dialect().groups[group].title)
            .note(state.origin.ofGroup(group), "one of them is set here");
      return;
    }
  }

private:
  /// Where jumps lead within this program: other ways come in there.
  void target(const Item &item, RuleContext &ctx) const {
    if ((item.kind != ItemKind::Jump && item.kind != ItemKind::Input) || ctx.callDepth() > 0 ||
        (item.kind == ItemKind::Jump && item.nameEnd > item.nameBegin))
      return;
    for (const Argument &argument : ctx.block().argumentsOf(item))
      if (const auto to = blockNamed(ctx.index(), ctx.block(), item, argument))
        memory().targets.try_emplace({ctx.source().id(), *to});
  }

  static bool states(GroupIndex group, const RuleContext &ctx) {
    return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      return ctx.code(use).group == group || ctx.code(use).action == Action::Reset;
    });
  }

  /// Only a block that moves depends on them.
  static bool uses(const RuleContext &ctx) { return ctx.block().hasAny(ctx.dialect().axisWords); }

  std::vector<GroupIndex> groups_;
};

} // namespace
NCVET_RULE(FlowStateDiffersAtJoin, flow_state_differs_at_join)
} // namespace ncvet
