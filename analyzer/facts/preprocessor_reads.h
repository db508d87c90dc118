// Values that the control reads while it prepares blocks, before the moves that precede are done.
#pragma once

#include "analyzer/rule/rule.h"

namespace ncvet {

/// Whether an expression of the current block reads one; `ofAxis`: one of an axis (`$AA_IM[X]`),
/// which every move changes.
inline bool readsAhead(const Expression &value, const RuleContext &ctx, bool ofAxis) {
  const Block &block = ctx.block();
  const auto operations = llvm::makeArrayRef(block.operations).slice(value.first, value.count);
  return llvm::any_of(operations, [&](const ExpressionOp &op) {
    if (op.op != Op::Opaque)
      return false;
    const llvm::StringRef text = ctx.text(SourceRange{ctx.source().id(), op.offset, block.end});
    const llvm::StringRef after =
        text.drop_while([](char c) { return c == '$' || c == '_' || llvm::isAlnum(c); });
    if (ofAxis && !(after.size() > 1 && after[0] == '[' && llvm::isAlpha(after[1])))
      return false;
    return llvm::any_of(ctx.dialect().readAhead,
                        [&](const std::string &name) { return text.startswith_insensitive(name); });
  });
}

/// Calls `visit` for each expression of the block that is computed as the block is prepared, with
/// the current event: `Statement` for the values and conditions of statements, `Block` for words.
template <typename Visit>
void eachPrepared(const Event &event, const RuleContext &ctx, Visit visit) {
  const Block &block = ctx.block();
  if (block.operations.empty())
    return;
  if (event.kind == EventKind::Block) {
    // What a keyword takes may be looked at later, as the move runs.
    if (!block.has(keywordAddress))
      for (const Word &word : block.words)
        if (word.has(wordExpression))
          visit(block.expressions[size_t(word.mantissa)]);
    return;
  }
  const Item &item = block.items[event.item()];
  if (item.kind == ItemKind::Assignment && item.value != noExpression)
    visit(block.expressions[item.value]);
  const bool decides = item.kind == ItemKind::If || item.kind == ItemKind::Structure ||
                       (item.kind == ItemKind::Jump && item.jump == JumpKind::ByValue);
  if (decides && item.condition < block.expressions.size())
    visit(block.expressions[item.condition]);
}

} // namespace ncvet
