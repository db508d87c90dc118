// A block is reached in different modes, depending on the path.
#include "analyzer/facts/lookahead.h"
#include "analyzer/program/block_reading.h"
#include "analyzer/program/project.h"
#include "analyzer/program/repeated_sections.h"
#include "analyzer/rule/rule.h"
#include "formats/dialect/control_facts.h"
#include "interp/evaluate/expression.h"

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
    if ((item.kind != ItemKind::Jump && item.kind != ItemKind::Input) || ctx.callDepth() > 0)
      return;
    if (item.kind == ItemKind::Jump && item.nameEnd > item.nameBegin)
      return intoProgram(item, ctx);
    for (const Argument &argument : ctx.block().argumentsOf(item))
      if (const auto to = blockNamed(ctx.index(), ctx.block(), item, argument))
        memory().targets.try_emplace({ctx.source().id(), *to});
  }

  /// A jump to a block of another program passes over what that program states before it.
  void intoProgram(const Item &item, RuleContext &ctx) const {
    const Block &block = ctx.block();
    const auto targets = block.argumentsOf(item);
    const llvm::StringRef name = ctx.source().text(item.nameBegin, item.nameEnd);
    if (targets.empty() || targets[0].kind != ArgumentKind::BlockNumber || !ctx.unit().project ||
        ctx.before().may(Fact::UnknownCode))
      return;
    const auto [unit, program] = ctx.unit().project->findProgram(ctx.unit(), name);
    const Value number = evaluate(block, targets[0].expression, ctx.before(), nullptr);
    if (!program || !number.isConstant())
      return;
    const auto target =
        unit->index.block(*program, std::llround(number.number.value()), program->begin);
    if (!target || *target - program->body > longestHead)
      return;
    std::map<GroupIndex, std::pair<CodeIndex, SourceRange>> passed;
    for (const Block &one : blocks(unit->index, program->body, *target))
      for (const Word &word : one.words)
        if (const CodeIndex code = codeOf(ctx.dialect(), word);
            code != noCode && llvm::is_contained(groups_, ctx.dialect().codes[code].group))
          passed[ctx.dialect().codes[code].group] = {
              code, {unit->source.id(), word.offset, one.endOf(word)}};
    Block first;
    unit->index.read(*target, first);
    for (const auto &[group, stated] : passed)
      if (passesOver(group, stated.first, first, ctx)) {
        if (auto finding = ctx.report(ctx.range(item), false))
          finding
              .message("the jump passes over `{0}` of `{1}`, and another state of {2} is in force "
                       "here",
                       ctx.text(stated.second), name, ctx.dialect().groups[group].title)
              .note(stated.second, "the program states it here, before the block of the jump");
        return;
      }
  }

  /// Whether another code of the group is in force, and the block relies on it.
  static bool passesOver(GroupIndex group, CodeIndex stated, const Block &first,
                         const RuleContext &ctx) {
    const uint64_t now = ctx.before().group(group);
    const CodeInfo &code = ctx.dialect().codes[stated];
    const bool restates = llvm::any_of(codesOf(ctx.dialect(), first), [&](CodeIndex index) {
      return ctx.dialect().codes[index].group == group;
    });
    return !restates && !(now & groupUnset) && !(now & (now - 1)) && code.bit < 64 &&
           now != uint64_t(1) << code.bit && first.hasAny(ctx.dialect().axisWords);
  }

  static bool states(GroupIndex group, const RuleContext &ctx) {
    return llvm::any_of(ctx.codes(), [&](const CodeUse &use) {
      return ctx.code(use).group == group || ctx.code(use).action == Action::Reset;
    });
  }

  /// Only a block that moves depends on them.
  static bool uses(const RuleContext &ctx) { return ctx.block().hasAny(ctx.dialect().axisWords); }

  /// Bytes before the target that are read: what a program states it states at its head.
  static constexpr uint32_t longestHead = 20000;

  std::vector<GroupIndex> groups_;
};

} // namespace
NCVET_RULE(FlowStateDiffersAtJoin, flow_state_differs_at_join)
} // namespace ncvet
