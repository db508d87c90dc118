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
    if (event.kind == EventKind::Statement) {
      const Item &item = ctx.block().items[size_t(event.number)];
      if (item.kind == ItemKind::Structure && item.structure == Structure::While)
        return bracketed(item, ctx);
      return backwards(item, ctx);
    }
    if (FlowIssue(event.number) != FlowIssue::EndlessLoop)
      return;
    if (auto finding = ctx.report(ctx.flowRange(), event.certain))
      finding.message("this loop never ends: nothing in it changes what decides about leaving it");
  }
  void remember(RuleMemory &memory) const override { memory(seen_); }

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
    const std::set<uint64_t> read = variablesOf(item, here);
    std::optional<uint32_t> back;
    for (const Argument &target : here.argumentsOf(item))
      if (const auto to = blockNamed(ctx.index(), here, target, here.begin); to && *to < here.begin)
        back = std::max(back.value_or(0), *to); // the shortest way back
    if (read.empty() || !back || here.begin - *back > readable)
      return;
    Block block;
    for (uint32_t at = *back; at < here.begin; at = block.next) {
      ctx.index().read(at, block);
      for (const Item &inner : block.items)
        if (inner.kind != ItemKind::Assignment)
          return;
      if (block.next <= at || mayChange(block, read, ctx))
        return;
    }
    const SourceRange range{ctx.source().id(), item.begin, item.end};
    if (auto finding = ctx.report(range))
      finding.message(
          "`{0}`: once it leads back it always does, nothing on the way changes what it "
          "looks at",
          ctx.text(range));
  }

  /// A WHILE over blocks that write nothing of what its condition looks at and do not leave.
  void bracketed(const Item &item, RuleContext &ctx) {
    const Block &here = ctx.block();
    if (item.condition == noExpression || !seen_.insert({ctx.source().id(), item.begin}).second ||
        evaluate(here, item.condition, ctx.before(), nullptr).isConstant())
      return;
    const std::set<uint64_t> read = variablesOf(item, here);
    const ProgramInfo &program = ctx.index().programAt(here.begin);
    if (read.empty() || here.begin - program.body > readable)
      return;
    Block block;
    // What the program gives no value may be changed from outside.
    std::set<uint64_t> given;
    for (uint32_t at = program.body; at < here.begin; at = block.next) {
      ctx.index().read(at, block);
      if (block.next <= at)
        return;
      for (const Item &other : block.items)
        if (other.kind == ItemKind::Assignment || other.kind == ItemKind::Definition)
          given.insert(block.keyOf(other.target));
    }
    if (!llvm::all_of(read, [&](uint64_t key) { return given.count(key); }))
      return;
    unsigned depth = 0;
    for (uint32_t at = here.next; at < program.end && at - here.begin < readable; at = block.next) {
      ctx.index().read(at, block);
      if (block.next <= at || mayChange(block, read, ctx))
        return;
      for (const Item &inner : block.items) {
        if (inner.kind == ItemKind::Structure && inner.structure == Structure::While) {
          ++depth;
        } else if (inner.kind == ItemKind::Structure && inner.structure == Structure::EndWhile) {
          if (depth-- == 0) {
            const SourceRange range{ctx.source().id(), item.begin, item.end};
            if (auto finding = ctx.report(range))
              finding.message("`{0}`: once the loop runs it never ends, nothing in it changes what "
                              "it looks at",
                              ctx.text(range));
            return;
          }
        } else if (inner.kind != ItemKind::Assignment && inner.kind != ItemKind::Structure) {
          return;
        } else if (inner.kind == ItemKind::Structure && inner.structure == Structure::For &&
                   read.count(block.keyOf(inner.target))) {
          return;
        }
      }
    }
  }

  /// The variables that decide; empty when something else decides as well.
  static std::set<uint64_t> variablesOf(const Item &item, const Block &block) {
    std::set<uint64_t> read;
    const Expression &condition = block.expressions[item.condition];
    for (uint32_t i = 0; i < condition.count; ++i) {
      const ExpressionOp &op = block.operations[condition.first + i];
      if (op.op == Op::Variable)
        read.insert(uint64_t(op.value));
      else if (op.op == Op::Opaque || op.op == Op::VariableAt || op.op == Op::ElementAt ||
               op.op == Op::Unknown)
        return {};
    }
    return read;
  }

  /// Whether a block of the loop may write one of the variables, or leave it.
  static bool mayChange(const Block &block, const std::set<uint64_t> &read,
                        const RuleContext &ctx) {
    for (const Item &inner : block.items)
      if (inner.kind == ItemKind::Assignment &&
          (read.count(block.keyOf(inner.target)) || !block.keyOf(inner.target)))
        return true;
    // What a code of the control leaves behind may be what is looked at.
    return block.skip >= 0 ||
           findCode(ctx.dialect(), block,
                    {Action::Return, Action::ProgramEnd, Action::ProgramEndRewind,
                     Action::ProgramStop, Action::OptionalStop}) ||
           llvm::any_of(codesOf(ctx.dialect(), block),
                        [&](CodeIndex code) { return !ctx.dialect().codes[code].stores.empty(); });
  }

  static constexpr uint32_t readable = 1u << 16; ///< bytes of a loop that are looked at
  std::set<std::pair<FileId, uint32_t>> seen_;
};

} // namespace
NCVET_RULE(FlowEndlessLoop, flow_endless_loop)
} // namespace ncvet
