// Blocks that no path reaches.
#include "analyzer/rule.h"

#include <algorithm>

namespace ncvet {
namespace {

/// Codes of the block with one of these actions, variants not looked at.
bool holdsCode(const Block &block, const Dialect &dialect, std::initializer_list<Action> actions) {
  for (const Word &word : block.words) {
    if (dialect.addresses[word.address].kind != AddressKind::Code || !word.isNumber())
      continue;
    const CodeIndex code = dialect.find(char('A' + word.address), word.codeNumber());
    if (code != noCode && llvm::is_contained(actions, dialect.codes[code].action))
      return true;
  }
  return false;
}

/// The last word or statement that ends what the block does.
SourceRange contentOf(const Block &block, const SourceFile &source) {
  uint32_t begin = block.end, end = block.begin;
  for (const Word &word : block.words) {
    begin = std::min(begin, word.offset);
    end = std::max(end, block.endOf(word));
  }
  for (const Item &item : block.items) {
    begin = std::min(begin, item.begin);
    end = std::max(end, item.end);
  }
  return {source.id(), begin, std::max(begin, end)};
}

class FlowUnreachableBlock final : public Rule {
public:
  void listen(Subscriptions &) override {}

  void finish(const FileSummary &file, RuleContext &ctx) override {
    if (!file.complete)
      return;
    for (const ProgramInfo &program : file.index.programs())
      if (!coveredWhole(file, program))
        check(file, program, ctx);
  }

private:
  static bool coveredWhole(const FileSummary &file, const ProgramInfo &program) {
    return llvm::any_of(file.reached, [&](const SourceRange &range) {
      return range.begin <= program.body && program.end <= range.end;
    });
  }

  /// Reports the first block of each unreached section that stands behind a return or a jump. What
  /// stands behind a program end is another rule's business, and a section that nothing in front of
  /// it leads around was not analysed at all.
  static void check(const FileSummary &file, const ProgramInfo &program, RuleContext &ctx) {
    Block block;
    bool leaves = false, previousReached = false;
    for (uint32_t at = program.body; at < program.end; at = std::max(block.next, at + 1)) {
      file.reader.read(at, block);
      if (block.isEmpty() || block.kind != BlockKind::Normal)
        continue;
      const bool reached = file.isReached(block.begin);
      if (!reached && previousReached && leaves && !onlyEndsLoop(block))
        if (auto finding = ctx.report(contentOf(block, file.source)))
          finding.message("no path leads to this block: it is never executed");
      previousReached = reached;
      leaves = block.skip < 0 && leadsAway(block, ctx.dialect());
    }
  }

  /// `END1` behind a jump out of the loop: nothing is lost.
  static bool onlyEndsLoop(const Block &block) {
    return block.words.empty() &&
           llvm::all_of(block.items, [](const Item &item) { return item.kind == ItemKind::End; });
  }

  static bool leadsAway(const Block &block, const Dialect &dialect) {
    if (holdsCode(block, dialect, {Action::Return}))
      return true;
    for (size_t i = 0; i < block.items.size(); ++i)
      if (block.items[i].kind == ItemKind::Jump)
        return i == 0 || block.items[i - 1].kind != ItemKind::If;
    return false;
  }
};

} // namespace
NCVET_RULE(FlowUnreachableBlock, flow_unreachable_block)
} // namespace ncvet
