// A loop has no way out.
#include "analyzer/lookahead.h"
#include "analyzer/repeated_sections.h"
#include "interp/expression.h"

#include <set>

namespace ncvet {
namespace {

class FlowEndlessLoop final : public Rule {
public:
  void listen(Subscriptions &to) override { to.on({EventKind::FlowIssue, EventKind::Statement}); }

  void on(const Event &event, RuleContext &ctx) override {
    if (event.kind == EventKind::Statement)
      return backwards(ctx.block().items[size_t(event.number)], ctx);
    if (FlowIssue(event.number) != FlowIssue::EndlessLoop)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message("this loop never ends: nothing in it changes what decides about leaving it");
  }

private:
  /// A choice that leads back, over blocks that write nothing of what it looks at and lead nowhere
  /// else.
  void backwards(const Item &item, RuleContext &ctx) {
    const Block &here = ctx.block();
    if (item.kind != ItemKind::Jump || item.jump != JumpKind::BySign || here.skip >= 0 ||
        item.nameEnd > item.nameBegin || item.condition == noExpression ||
        !seen_.insert({ctx.source().id(), item.begin}).second)
      return;
    // Where the value is known the loop is run for real.
    if (evaluate(here, item.condition, ctx.before(), nullptr).isConstant())
      return;
    std::set<uint64_t> read;
    const Expression &condition = here.expressions[item.condition];
    for (uint32_t i = 0; i < condition.count; ++i) {
      const ExpressionOp &op = here.operations[condition.first + i];
      if (op.op == Op::Variable)
        read.insert(uint64_t(op.value));
      else if (op.op == Op::Opaque || op.op == Op::VariableAt || op.op == Op::ElementAt)
        return;
    }
    std::optional<uint32_t> back;
    for (const Argument &target : here.argumentsOf(item))
      if (const auto to = blockNamed(ctx.index(), here, target, here.begin); to && *to < here.begin)
        back = std::max(back.value_or(0), *to); // the shortest way back
    if (read.empty() || !back || here.begin - *back > readable)
      return;
    Block block;
    for (uint32_t at = *back; at < here.begin; at = block.next) {
      ctx.index().reader().read(at, block);
      for (const Item &inner : block.items)
        if (inner.kind != ItemKind::Assignment || read.count(block.keyOf(inner.target)) ||
            !block.keyOf(inner.target))
          return;
      if (block.skip >= 0 || block.next <= at ||
          findCode(ctx.dialect(), block,
                   {Action::Return, Action::ProgramEnd, Action::ProgramEndRewind,
                    Action::ProgramStop, Action::OptionalStop}))
        return;
      // What a code of the control leaves behind may be what is looked at.
      for (const CodeIndex code : codesOf(ctx.dialect(), block))
        if (!ctx.dialect().codes[code].stores.empty())
          return;
    }
    const SourceRange range{ctx.source().id(), item.begin, item.end};
    if (auto finding = ctx.report(range))
      finding.message(
          "`{0}`: once it leads back it always does, nothing on the way changes what it "
          "looks at",
          ctx.text(range));
  }

  static constexpr uint32_t readable = 1u << 16; ///< bytes of a loop that are looked at
  std::set<std::pair<FileId, uint32_t>> seen_;
};

} // namespace
NCVET_RULE(FlowEndlessLoop, flow_endless_loop)
} // namespace ncvet
